// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/observations.h"

#include "measurement/tool_pose.h"
#include "model/predict.h"

namespace hexcal {

Observations MakeObservations(const Dataset& dataset) {
  const std::vector<Pose3d> base_from_platform = ReportedPoses(dataset);
  const std::vector<Matrix6d> robot_covariances = ReportedCovariances(dataset, base_from_platform);
  const ToolPoses tool_poses = ComputeToolPoses(dataset);

  Observations observations;
  observations.tool_noise_is_known = tool_poses.has_covariance;
  observations.has_robot_noise = !robot_covariances.empty();
  observations.tracker_from_world = tool_poses.tracker_from_world;
  if (tool_poses.has_covariance)
    observations.tracker_from_world_covariance = tool_poses.tracker_from_world_covariance;
  observations.warnings = dataset.warnings;
  observations.warnings.insert(
      observations.warnings.end(), tool_poses.warnings.begin(), tool_poses.warnings.end());
  observations.items.reserve(tool_poses.poses.size());
  for (const ToolPose& tool : tool_poses.poses) {
    Observation item;
    item.label = dataset.robot_poses.rows[tool.pose].label;
    item.base_from_platform = base_from_platform[tool.pose];
    item.world_from_tool = tool.world_from_tool;
    if (tool_poses.has_covariance) item.tool_covariance = tool.covariance;
    if (observations.has_robot_noise) item.robot_covariance = robot_covariances[tool.pose];
    observations.items.push_back(std::move(item));
  }
  return observations;
}

Matrix6d ErrorCovariance(const Observation& observation,
                         const Observations& observations,
                         const Pose3d& platform_from_tool,
                         const NoiseLevels& levels) {
  Matrix6d covariance = observation.tool_covariance;
  if (!observations.tool_noise_is_known) {
    covariance.diagonal().head<3>().setConstant(levels.position * levels.position);
    covariance.diagonal().tail<3>().setConstant(levels.orientation * levels.orientation);
  }
  if (observations.has_robot_noise) {
    const Matrix6d carry = InverseAdjoint(platform_from_tool);
    covariance += carry * observation.robot_covariance * carry.transpose();
  }
  return covariance;
}

}  // namespace hexcal
