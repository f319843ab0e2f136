// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/weights.h"

#include "residuals/whitener.h"

namespace hexcal {

PoseWeights WeightsOf(const Observations& observations,
                      const Pose3d& platform_from_tool,
                      const NoiseLevels& levels) {
  const auto covariance = [&](const Observation& o) {
    return ErrorCovariance(o, observations, platform_from_tool, levels);
  };
  if (!observations.tool_noise_is_known && !observations.has_robot_noise)
    return PoseWeights::Isotropic(levels.position, levels.orientation);
  if (HasCommonCovariance(observations))
    return PoseWeights::Common(covariance(observations.items[0]));
  PoseWeights weights = PoseWeights::PerPose(observations.items.size());
  for (const Observation& o : observations.items) weights.Add(covariance(o));
  return weights;
}

std::vector<Matrix6d> WhitenersOf(const Observations& observations,
                                  const Pose3d& platform_from_tool,
                                  const NoiseLevels& levels) {
  std::vector<Matrix6d> whiteners;
  whiteners.reserve(observations.items.size());
  for (const Observation& o : observations.items)
    whiteners.push_back(WhitenerOf(ErrorCovariance(o, observations, platform_from_tool, levels)));
  return whiteners;
}

}  // namespace hexcal
