// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "estimator/observations.h"
#include "residuals/pose_error.h"

namespace hexcal {

// Why that to which a solver has converged is no solution, in words; empty where nothing speaks
// against it. could_be_local: it did not start from the best closed form.
std::string WhyNoSolution(const std::vector<Observation>& observations,
                          const BaseAndTool& mounts,
                          bool could_be_local);

}  // namespace hexcal
