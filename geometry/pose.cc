// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/pose.h"

namespace hexcal {

Matrix6d InverseAdjoint(const Pose3d& b_from_c) {
  const Eigen::Matrix3d inverse = b_from_c.rotation.toRotationMatrix().transpose();
  Matrix6d m = Matrix6d::Zero();
  m.topLeftCorner<3, 3>() = inverse;
  m.topRightCorner<3, 3>() = -inverse * Skew(b_from_c.translation);
  m.bottomRightCorner<3, 3>() = inverse;
  return m;
}

Eigen::Matrix3d LeftJacobianInverse(const Eigen::Vector3d& v) {
  const double squared = v.squaredNorm();
  const double angle = std::sqrt(squared);
  // (1 - (a/2) cot(a/2)) / a^2; its series where the quotient loses digits.
  const double half = 0.5 * angle;
  const double factor = angle < 1e-2 ? 1.0 / 12 + squared / 720 + squared * squared / 30240
                                     : (1.0 - half * std::cos(half) / std::sin(half)) / squared;
  const Eigen::Matrix3d skew = Skew(v);
  return Eigen::Matrix3d::Identity() - 0.5 * skew + factor * skew * skew;
}

Eigen::Matrix3d RightJacobian(const Eigen::Vector3d& v) {
  const double squared = v.squaredNorm();
  const double angle = std::sqrt(squared);
  // (1 - cos a) / a^2 and (a - sin a) / a^3; their series where the quotients lose digits.
  const bool small = angle < 1e-2;
  const double half_sine = std::sin(0.5 * angle);
  const double first =
      small ? 0.5 - squared / 24 + squared * squared / 720 : 2.0 * half_sine * half_sine / squared;
  const double second = small ? 1.0 / 6 - squared / 120 + squared * squared / 5040
                              : (angle - std::sin(angle)) / (angle * squared);
  const Eigen::Matrix3d skew = Skew(v);
  return Eigen::Matrix3d::Identity() - first * skew + second * skew * skew;
}

}  // namespace hexcal
