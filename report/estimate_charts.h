// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "estimator/estimate.h"
#include "estimator/pose_check.h"
#include "report/html/page.h"

namespace hexcal {

// Pictures of a calibration, each with the table of its numbers. mm and mrad.

// How a solver arrived: RMS errors after each iteration. solver: "nonlinear solver".
Chart ConvergenceChart(const std::vector<IterationRecord>& iterations, const std::string& solver);

// Each pose as the others predict it, in squared sigmas, and the limit of 95 %.
Chart HeldOutChart(const std::vector<PoseCheck>& poses, const std::vector<bool>& used);

// How large an error of each pose would have to be to be found.
Chart SmallestChart(const std::vector<PoseCheck>& poses, const std::vector<bool>& used);

}  // namespace hexcal
