// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/rotation_angles.h"

#include <Eigen/LU>
#include <cmath>

namespace hexcal {

// cos(ry) below this: rx and rz turn about the same axis.
constexpr double kGimbal = 1e-10;

Eigen::Matrix3d RotationFromAngles(const Eigen::Vector3d& angles) {
  const double cx = std::cos(angles.x()), sx = std::sin(angles.x());
  const double cy = std::cos(angles.y()), sy = std::sin(angles.y());
  const double cz = std::cos(angles.z()), sz = std::sin(angles.z());
  Eigen::Matrix3d q;                                              // Eq. (28)
  q << cy * cz, -cy * sz, sy,                                     //
      sx * sy * cz + cx * sz, -sx * sy * sz + cx * cz, -sx * cy,  //
      -cx * sy * cz + sx * sz, cx * sy * sz + sx * cz, cx * cy;
  return q;
}

Eigen::Vector3d AnglesFromRotation(const Eigen::Matrix3d& q) {
  const Eigen::Vector3d n = q.col(0), o = q.col(1), a = q.col(2);
  const double rx = std::hypot(a.y(), a.z()) > kGimbal ? std::atan2(-a.y(), a.z()) : 0.0;
  const double c = std::cos(rx), s = std::sin(rx);
  return {rx,
          std::atan2(a.x(), -a.y() * s + a.z() * c),
          std::atan2(n.y() * c + n.z() * s, o.y() * c + o.z() * s)};
}

Eigen::Matrix3d AnglesByTurn(const Eigen::Vector3d& angles) {
  const double cy = std::cos(angles.y()), sy = std::sin(angles.y());
  const double cz = std::cos(angles.z()), sz = std::sin(angles.z());
  Eigen::Matrix3d turn_by_angles;  // columns Rz' Ry' ex, Rz' ey, ez
  turn_by_angles << cy * cz, sz, 0, -cy * sz, cz, 0, sy, 0, 1;
  return turn_by_angles.inverse();
}

Pose3d PoseFromVector(const Vector6d& pose_vector) {
  return MakePose(RotationFromAngles(pose_vector.tail<3>()), pose_vector.head<3>());
}

Vector6d VectorFromPose(const Pose3d& pose) {
  Vector6d v;
  v << pose.translation, AnglesFromRotation(pose.rotation.toRotationMatrix());
  return v;
}

}  // namespace hexcal
