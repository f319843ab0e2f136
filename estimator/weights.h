// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "estimator/observations.h"
#include "residuals/pose_batch.h"

namespace hexcal {

// The inverse of every observation's ErrorCovariance, for the streaming pass and for rows: W with
// W' W = C^-1.
PoseWeights WeightsOf(const Observations& observations,
                      const Pose3d& platform_from_tool,
                      const NoiseLevels& levels);
std::vector<Matrix6d> WhitenersOf(const Observations& observations,
                                  const Pose3d& platform_from_tool,
                                  const NoiseLevels& levels);

}  // namespace hexcal
