// SPDX-License-Identifier: BSD-3-Clause
#include "residuals/pose_manifold.h"

namespace hexcal {
namespace {

using Matrix43d = Eigen::Matrix<double, 4, 3>;

// d(q Exp(v))/dv at v = 0 for coefficients in the order x y z w, times two; its columns are
// orthonormal.
Matrix43d TwiceQuaternionStep(const double* q) {
  const double x = q[0], y = q[1], z = q[2], w = q[3];
  Matrix43d m;
  m << w, -z, y,  //
      z, w, -x,   //
      -y, x, w,   //
      -x, -y, -z;
  return m;
}

Eigen::Matrix3d Rotation(const double* x) {
  return Pose3d::FromParameters(x).rotation.toRotationMatrix();
}

}  // namespace

bool PoseManifold::Plus(const double* x, const double* delta, double* x_plus_delta) const {
  const Vector6d d = Eigen::Map<const Vector6d>(delta);
  hexcal::Plus(Pose3d::FromParameters(x), d).ToParameters(x_plus_delta);
  return true;
}

bool PoseManifold::PlusJacobian(const double* x, double* jacobian) const {
  Eigen::Map<Eigen::Matrix<double, 7, 6, Eigen::RowMajor>> j(jacobian);
  j.setZero();
  j.topLeftCorner<3, 3>() = Rotation(x);
  j.bottomRightCorner<4, 3>() = 0.5 * TwiceQuaternionStep(x + 3);
  return true;
}

bool PoseManifold::Minus(const double* y, const double* x, double* y_minus_x) const {
  Eigen::Map<Vector6d>{y_minus_x} =
      hexcal::Minus(Pose3d::FromParameters(y), Pose3d::FromParameters(x));
  return true;
}

bool PoseManifold::MinusJacobian(const double* x, double* jacobian) const {
  Eigen::Map<Eigen::Matrix<double, 6, 7, Eigen::RowMajor>> j(jacobian);
  j.setZero();
  j.topLeftCorner<3, 3>() = Rotation(x).transpose();
  j.bottomRightCorner<3, 4>() = 2.0 * TwiceQuaternionStep(x + 3).transpose();
  return true;
}

}  // namespace hexcal
