// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/observations.h"

#include <algorithm>
#include <limits>

#include "geometry/align_points.h"
#include "measurement/tool_pose.h"
#include "model/predict.h"

namespace hexcal {
namespace {

// A spread below this part of the distances, or below this angle, rad, is none.
constexpr double kNoSpread = 1e-3;

// Root mean square distance from the mean.
double SpreadOf(const Eigen::Matrix3Xd& points) {
  const Eigen::Vector3d mean = points.rowwise().mean();
  return std::sqrt((points.colwise() - mean).colwise().squaredNorm().mean());
}

}  // namespace

Observations MakeObservations(const Dataset& dataset) {
  const std::vector<Pose3d> base_from_platform = ReportedPoses(dataset);
  const std::vector<Matrix6d> robot_covariances = ReportedCovariances(dataset, base_from_platform);
  const ToolPoses tool_poses = ComputeToolPoses(dataset);

  Observations observations;
  observations.tool_noise_is_known = tool_poses.has_covariance;
  observations.has_robot_noise = !robot_covariances.empty();
  observations.tracker_from_world = tool_poses.tracker_from_world;
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
  Matrix6d covariance = Matrix6d::Zero();
  if (observations.tool_noise_is_known) {
    covariance = observation.tool_covariance;
  } else {
    covariance.diagonal().head<3>().setConstant(levels.position * levels.position);
    covariance.diagonal().tail<3>().setConstant(levels.orientation * levels.orientation);
  }
  if (observations.has_robot_noise) {
    const Matrix6d carry = InverseAdjoint(platform_from_tool);
    covariance += carry * observation.robot_covariance * carry.transpose();
  }
  return covariance;
}

bool HasCommonCovariance(const Observations& observations) {
  const Observation& first = observations.items[0];
  return std::all_of(
      observations.items.begin(), observations.items.end(), [&](const Observation& o) {
        return (!observations.tool_noise_is_known || o.tool_covariance == first.tool_covariance) &&
               (!observations.has_robot_noise || o.robot_covariance == first.robot_covariance);
      });
}

LinearisedError Linearise(const Observation& observation, const BaseAndTool& mounts) {
  const Vector6d error =
      PoseError(mounts, observation.base_from_platform, observation.world_from_tool);
  return {error,
          PoseErrorJacobian(error, observation.base_from_platform * mounts.platform_from_tool)};
}

NoiseLevels Spread(const std::vector<Observation>& observations) {
  const auto n = static_cast<Eigen::Index>(observations.size());
  Eigen::Matrix3Xd in_world(3, n), in_base(3, n);
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (Eigen::Index i = 0; i < n; ++i) {
    in_world.col(i) = observations[i].world_from_tool.translation;
    in_base.col(i) = observations[i].base_from_platform.translation;
    sum += observations[i].world_from_tool.rotation.toRotationMatrix();
  }
  const Eigen::Quaterniond mean(NearestRotation(sum));
  double squared = 0.0;
  for (const Observation& o : observations)
    squared += Log(Eigen::Quaterniond(mean.conjugate() * o.world_from_tool.rotation)).squaredNorm();
  const double position = std::max(
      {SpreadOf(in_world), SpreadOf(in_base), kNoSpread * in_base.colwise().norm().maxCoeff()});
  return {position > 0 ? position : 1.0,
          std::max(std::sqrt(squared / static_cast<double>(n)), kNoSpread)};
}

NoiseLevels Rounding(const std::vector<Observation>& observations) {
  double size = 0.0;
  for (const Observation& o : observations)
    size = std::max(
        {size, o.world_from_tool.translation.norm(), o.base_from_platform.translation.norm()});
  const double epsilon = std::numeric_limits<double>::epsilon();
  return {epsilon * (size > 0 ? size : 1.0), epsilon};
}

}  // namespace hexcal
