// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "geometry/pose.h"

namespace hexcal {

// Rotation of the paper's Eq. (2) and (26): Rx(rx) Ry(ry) Rz(rz), rad.
Eigen::Matrix3d RotationFromAngles(const Eigen::Vector3d& angles);

// The angles of Eq. (29): rx and rz in (-pi, pi], ry in [-pi/2, pi/2]. At the gimbal (|ry| = pi/2,
// where only rx +- rz is determined) rx is set to zero.
Eigen::Vector3d AnglesFromRotation(const Eigen::Matrix3d& rotation);

// d(rx ry rz) / d(right rotation vector) at these angles. Infinite or huge near the gimbal.
Eigen::Matrix3d AnglesByTurn(const Eigen::Vector3d& angles);

// Eq. (2): Tra(x, y, z) Rot(x, rx) Rot(y, ry) Rot(z, rz) of [x y z rx ry rz], m and rad, and back
// (Eq. 30).
Pose3d PoseFromVector(const Vector6d& pose_vector);
Vector6d VectorFromPose(const Pose3d& pose);

}  // namespace hexcal
