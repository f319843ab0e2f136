// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <random>
#include <string>

#include "estimator/pivot_poses.h"
#include "testing/random.h"

namespace hexcal::testing {

// A tool whose tip rests at pivot while its axes are tilted by up to cone rad about a random axis.
struct PivotScene {
  TipAndPivot truth = {{0.012, -0.007, 0.15}, {0.3, -0.2, 1.8}};
  int poses = 30;
  double cone = 0.5;
};

inline PivotPose PivotPoseAt(const Eigen::Quaterniond& rotation,
                             const TipAndPivot& truth,
                             const Matrix6d& covariance,
                             std::size_t index) {
  PivotPose pose;
  pose.label = std::to_string(index + 1);
  pose.world_from_tool = {truth.pivot_in_world - rotation * truth.tip_in_tool, rotation};
  pose.covariance = covariance;
  return pose;
}

// Poses without noise. covariance: stated for each, not drawn.
template <typename Rng>
PivotPoses DrawPivotPoses(const PivotScene& pivoting, const Matrix6d& covariance, Rng& rng) {
  PivotPoses poses;
  poses.noise = PivotNoise::kKnown;
  const Eigen::Quaterniond stand = Exp(Eigen::Vector3d(0.4, -0.9, 0.3));
  for (int i = 0; i < pivoting.poses; ++i)
    poses.items.push_back(PivotPoseAt(stand * Exp(UniformVector(rng, pivoting.cone)),
                                      pivoting.truth,
                                      covariance,
                                      poses.items.size()));
  return poses;
}

// The same poses, each moved by its own draw of its covariance.
template <typename Rng>
PivotPoses WithNoise(PivotPoses poses, Rng& rng) {
  for (PivotPose& pose : poses.items) {
    const Vector6d draw = pose.covariance.llt().matrixL() * Normal(rng, 6);
    pose.world_from_tool = Plus(pose.world_from_tool, draw);
  }
  return poses;
}

// Independent of the axes: sigmas of a coordinate, m, and of an angle, rad.
inline Matrix6d IsotropicNoise(double position, double orientation) {
  Vector6d variances;
  variances << Eigen::Vector3d::Constant(position * position),
      Eigen::Vector3d::Constant(orientation * orientation);
  return variances.asDiagonal();
}

}  // namespace hexcal::testing
