// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <vector>

#include "estimator/estimate.h"
#include "residuals/robust_loss.h"

namespace hexcal {

struct NonlinearOptions {
  int max_iterations = 100;
  double tolerance = 1e-12;  // of the cost and of the parameters, relative; what follows is Polish
  // Called after every iteration with the number done and the largest number; for a progress bar.
  std::function<void(int, int)> after_iteration;
};

// The Ceres problem: world_from_base and platform_from_tool on PoseManifold, one PoseResidual an
// observation with the given whiteners (one an observation), Levenberg-Marquardt with dense QR; a
// loss by Ceres's own class.
Solution SolveNonlinear(const std::vector<Observation>& observations,
                        const std::vector<Matrix6d>& whiteners,
                        const BaseAndTool& start,
                        const NonlinearOptions& options,
                        const RobustLoss& loss = {});

}  // namespace hexcal
