// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "estimator/observations.h"
#include "residuals/pose_error.h"
#include "residuals/robust_loss.h"

namespace hexcal {

// Why that to which a solver has converged is no solution, in words; empty where nothing speaks
// against it. could_be_local: it did not start from the best closed form.
std::string WhyNoSolution(const std::vector<Observation>& observations,
                          const BaseAndTool& mounts,
                          bool could_be_local);

// Why a loss has left nothing to fit: the poses that it does not weigh down to nothing tell no more
// than the 12 parameters take. Empty where they do.
std::string WhyNothingCounts(const std::vector<Observation>& observations,
                             const std::vector<Matrix6d>& whiteners,
                             const BaseAndTool& mounts,
                             const RobustLoss& loss);

}  // namespace hexcal
