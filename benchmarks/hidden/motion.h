// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace hexcal::hidden {

// The generator's own rigid motions: nothing here comes from geometry/, so that a mistake there is
// not repeated here.

using Six = Eigen::Matrix<double, 6, 1>;

// x_in_a = turn * x_in_b + shift, m.
struct Motion {
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();
};

Motion operator*(const Motion& a_from_b, const Motion& b_from_c);
Eigen::Vector3d operator*(const Motion& a_from_b, const Eigen::Vector3d& x_in_b);
Motion Inverse(const Motion& a_from_b);

// Rodrigues' formula; rad.
Eigen::Matrix3d TurnBy(const Eigen::Vector3d& rotation_vector);
// Its inverse, for turns below pi.
Eigen::Vector3d RotationVector(const Eigen::Matrix3d& turn);
// Shepperd's method: w, x, y, z with w >= 0.
Eigen::Vector4d QuaternionOf(const Eigen::Matrix3d& turn);

// The paper's Eq. (2): Tra(x, y, z) Rot(x, rx) Rot(y, ry) Rot(z, rz).
Motion FromPoseVector(const Six& vector);

// from * (twist[0:3], turn by twist[3:6]), the translation not coupled to the rotation.
Motion Moved(const Motion& from, const Six& twist);
// The twist with Moved(from, twist) = to.
Six TwistBetween(const Motion& from, const Motion& to);

}  // namespace hexcal::hidden
