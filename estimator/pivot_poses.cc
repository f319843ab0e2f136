// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/pivot_poses.h"

#include <cmath>
#include <limits>

#include "geometry/linear_algebra.h"

namespace hexcal {
namespace {

Eigen::Matrix3d MeanRotation(const std::vector<PivotPose>& poses,
                             const std::vector<std::size_t>& indices) {
  Eigen::Matrix3d mean = Eigen::Matrix3d::Zero();
  for (const std::size_t i : indices) mean += poses[i].world_from_tool.rotation.toRotationMatrix();
  return mean / static_cast<double>(indices.size());
}

std::vector<std::size_t> All(std::size_t count) {
  std::vector<std::size_t> indices(count);
  for (std::size_t i = 0; i < count; ++i) indices[i] = i;
  return indices;
}

}  // namespace

PivotPoses MakePivotPoses(const Pivoting& pivoting, const std::optional<NoiseLevels>& noise) {
  PivotPoses poses;
  const bool has_shape = pivoting.dataset.measurement->kind == Measurement::Kind::kMarkers;
  poses.noise = pivoting.poses.has_covariance || noise ? PivotNoise::kKnown
                : has_shape                            ? PivotNoise::kUpToScale
                                                       : PivotNoise::kUnknown;
  const PoseNoise levels = {Eigen::Vector3d::Constant(noise ? noise->position : 0.0),
                            Eigen::Vector3d::Constant(noise ? noise->orientation : 0.0)};
  const bool takes_levels = noise && !pivoting.poses.has_covariance;
  for (const ToolPose& pose : pivoting.poses.poses) {
    const RobotPose& row = pivoting.dataset.robot_poses.rows[pose.pose];
    poses.items.push_back({row.label,
                           row.line,
                           pose.world_from_tool,
                           takes_levels ? levels.Covariance() : pose.covariance});
  }
  return poses;
}

Tilts FindTilts(const std::vector<PivotPose>& poses) {
  const std::vector<std::size_t> all = All(poses.size());
  const Eigen::Matrix3d mean = MeanRotation(poses, all);
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const PivotPose& pose : poses) {
    const Eigen::Matrix3d off = pose.world_from_tool.rotation.toRotationMatrix() - mean;
    spread += off.transpose() * off;
  }
  const Eigenvalues eigen = DecomposeSymmetric(spread / static_cast<double>(poses.size()));
  return {eigen.values.cwiseMax(0.0).cwiseSqrt(), eigen.vectors};
}

double PivotCondition(const Tilts& tilts) {
  // The singular values are sqrt(n (1 +- s)), s those of the mean rotation, and 1 - s^2 = rms^2.
  const double squared = tilts.rms[0] * tilts.rms[0];
  return squared > 0.0 ? (1.0 + std::sqrt(std::max(0.0, 1.0 - squared))) / tilts.rms[0]
                       : std::numeric_limits<double>::infinity();
}

TipAndPivot SolvePivotAlgebraically(const std::vector<PivotPose>& poses,
                                    const std::vector<std::size_t>& indices,
                                    const Eigen::Matrix3Xd& basis) {
  const Eigen::Matrix3d mean = MeanRotation(poses, indices);
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (const std::size_t i : indices) centre += poses[i].world_from_tool.translation;
  centre /= static_cast<double>(indices.size());
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (const std::size_t i : indices) {
    const Eigen::Matrix3d off = poses[i].world_from_tool.rotation.toRotationMatrix() - mean;
    spread += off.transpose() * off;
    right -= off.transpose() * (poses[i].world_from_tool.translation - centre);
  }
  TipAndPivot x;
  if (basis.cols() > 0) {
    const Eigen::MatrixXd within = basis.transpose() * spread * basis;
    x.tip_in_tool = basis * within.ldlt().solve(basis.transpose() * right);
  }
  x.pivot_in_world = mean * x.tip_in_tool + centre;
  return x;
}

Eigen::Vector3d PivotError(const Pose3d& world_from_tool, const TipAndPivot& x) {
  return x.tip_in_tool +
         world_from_tool.rotation.conjugate() * (world_from_tool.translation - x.pivot_in_world);
}

}  // namespace hexcal
