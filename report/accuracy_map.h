// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "estimator/target_error.h"
#include "report/workspace.h"

namespace hexcal {

// How long a point's error may be over the workspace, by the position of the platform: at each the
// worst of the orientations at the ends and in the middle of their ranges.
struct AccuracyMap {
  std::vector<double> x, y, z;  // of T_A^B, m
  // lengths[z][y][x], m; NaN where the legs reach no orientation.
  std::vector<std::vector<std::vector<double>>> lengths;
};

AccuracyMap MapAccuracy(const TargetError& error,
                        const Eigen::Vector3d& p_in_tool,
                        const Workspace& workspace,
                        const Dataset& dataset,
                        double probability);

}  // namespace hexcal
