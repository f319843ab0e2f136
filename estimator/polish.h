// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "estimator/covariance.h"
#include "estimator/observations.h"
#include "residuals/robust_loss.h"

namespace hexcal {

// The shortest y that minimises the sum of |whitener (e + J y)|^2 at mounts, J by
// PoseErrorJacobian, and by how much of the cost (half the sum) that is expected to be less.
struct WeightedStep {
  Vector12d y;
  double decrease = 0.0;
};
WeightedStep StepFrom(const std::vector<Observation>& observations,
                      const std::vector<Matrix6d>& whiteners,
                      const BaseAndTool& mounts);

BaseAndTool Moved(const BaseAndTool& mounts, const Vector12d& step);

// The whiteners times the roots of the weights that the loss gives the poses at mounts.
std::vector<Matrix6d> Weighted(const std::vector<Observation>& observations,
                               const std::vector<Matrix6d>& whiteners,
                               const BaseAndTool& mounts,
                               const RobustLoss& loss);

// Takes a solution that has converged by its cost to where the gradient is zero to rounding. A cost
// that is flat to 1 part in 1e15 leaves the parameters 1e-8 of a standard deviation apart, which
// depends on the order of the rows; this does not.
BaseAndTool Polish(const std::vector<Observation>& observations,
                   const std::vector<Matrix6d>& whiteners,
                   const BaseAndTool& mounts,
                   const RobustLoss& loss = {});

}  // namespace hexcal
