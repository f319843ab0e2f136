// SPDX-License-Identifier: BSD-3-Clause
#include "model/plates.h"

#include <Eigen/Geometry>
#include <cmath>

#include "geometry/linear_algebra.h"

namespace hexcal {
namespace {

Matrix36d RadialDirections(const Matrix36d& joints) {
  const Matrix36d spread = joints.colwise() - joints.rowwise().mean();
  const Eigen::Vector3d normal = DecomposeSymmetric(spread * spread.transpose()).vectors.col(0);
  const Matrix36d in_plane = spread - normal * (normal.transpose() * spread);
  return in_plane.colwise().normalized();
}

}  // namespace

Plates PlatesOf(const HexapodGeometry& hexapod) {
  Plates plates;
  plates.base_joints = hexapod.base_joints_in_base;
  plates.platform_joints = hexapod.platform_joints_in_platform;
  plates.base_radial = RadialDirections(plates.base_joints);
  plates.platform_radial = RadialDirections(plates.platform_joints);
  plates.base_axes = hexapod.base_axes_in_base.value_or(plates.base_radial);
  plates.platform_axes = hexapod.platform_axes_in_platform.value_or(plates.platform_radial);
  return plates;
}

Matrix36d LegsInBase(const Plates& plates, const Pose3d& base_from_platform) {
  const Eigen::Matrix3d rotation = base_from_platform.rotation.toRotationMatrix();
  const Matrix36d legs =
      ((rotation * plates.platform_joints).colwise() + base_from_platform.translation) -
      plates.base_joints;
  return legs.colwise().normalized();
}

Vector6d LegRoll(const Plates& plates, const Pose3d& base_from_platform) {
  const Matrix36d legs = LegsInBase(plates, base_from_platform);
  Vector6d roll;
  for (int i = 0; i < kNumLegs; ++i) {
    const Eigen::Vector3d along = legs.col(i);
    const Eigen::Vector3d lower = plates.base_axes.col(i);
    const Eigen::Vector3d upper =
        base_from_platform.rotation * Eigen::Vector3d(plates.platform_axes.col(i));
    // The parts across the leg have this cosine and this sine, times the same positive factor.
    const double cosine = lower.dot(upper) - along.dot(lower) * along.dot(upper);
    roll[i] = std::atan2(along.dot(lower.cross(upper)), cosine);
  }
  return roll;
}

}  // namespace hexcal
