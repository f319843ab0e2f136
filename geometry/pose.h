// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>

namespace hexcal {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;
using Matrix34d = Eigen::Matrix<double, 3, 4>;

template <typename T>
Eigen::Matrix<T, 3, 3> Skew(const Eigen::Matrix<T, 3, 1>& v) {
  Eigen::Matrix<T, 3, 3> m;
  m << T(0), -v.z(), v.y(), v.z(), T(0), -v.x(), -v.y(), v.x(), T(0);
  return m;
}

// Unit quaternion of a rotation vector, rad; smooth at zero, for automatic derivatives too.
template <typename T>
Eigen::Quaternion<T> Exp(const Eigen::Matrix<T, 3, 1>& rotation_vector) {
  using std::cos;
  using std::sin;
  using std::sqrt;
  const T squared = rotation_vector.squaredNorm();
  if (squared < T(1e-12)) {
    // sin(a/2)/a and cos(a/2) to fourth order: exact to rounding below a = 1e-6.
    const T half_sinc = T(0.5) - squared / T(48);
    const Eigen::Matrix<T, 3, 1> v = half_sinc * rotation_vector;
    return Eigen::Quaternion<T>(T(1) - squared / T(8), v.x(), v.y(), v.z());
  }
  const T angle = sqrt(squared);
  const T half_sinc = sin(angle / T(2)) / angle;
  const Eigen::Matrix<T, 3, 1> v = half_sinc * rotation_vector;
  return Eigen::Quaternion<T>(cos(angle / T(2)), v.x(), v.y(), v.z());
}

// Rotation vector, rad, of a unit quaternion; its length is in [0, pi].
template <typename T>
Eigen::Matrix<T, 3, 1> Log(const Eigen::Quaternion<T>& q) {
  using std::atan2;
  using std::sqrt;
  const Eigen::Matrix<T, 3, 1> v = q.vec();
  const T squared = v.squaredNorm();
  const T w = q.w();
  if (squared < T(1e-12)) {
    // angle/sin(angle/2) = 2 (1 + s^2/6) with s = |v|, and the nearer of q and -q.
    const T scale = T(2) + squared / T(3);
    if (w < T(0)) return -scale * v;
    return scale * v;
  }
  const T norm = sqrt(squared);
  const T angle = w < T(0) ? -T(2) * atan2(norm, -w) : T(2) * atan2(norm, w);
  return (angle / norm) * v;
}

// A rigid transform a_from_b: p_in_a = rotation * p_in_b + translation, translation = origin of b
// in a, m. A small motion is d = [translation m, rotation rad] on the right (paper, Eqs. 5-6 and
// 44-45):
//   x [+] d = x * (d[0:3], Exp(d[3:6])),  translation and rotation not coupled.
template <typename T>
struct Pose {
  using Vector3 = Eigen::Matrix<T, 3, 1>;
  using Vector6 = Eigen::Matrix<T, 6, 1>;

  Vector3 translation = Vector3::Zero();
  Eigen::Quaternion<T> rotation = Eigen::Quaternion<T>::Identity();

  // Parameter block of an estimator: [tx ty tz qx qy qz qw].
  static constexpr int kNumParameters = 7;
  static constexpr int kNumDof = 6;

  static Pose FromParameters(const T* p) {
    return {Vector3(p[0], p[1], p[2]), Eigen::Quaternion<T>(p[6], p[3], p[4], p[5])};
  }
  void ToParameters(T* p) const {
    p[0] = translation.x(), p[1] = translation.y(), p[2] = translation.z();
    p[3] = rotation.x(), p[4] = rotation.y(), p[5] = rotation.z(), p[6] = rotation.w();
  }

  Pose operator*(const Pose& b) const {
    return {translation + rotation * b.translation, rotation * b.rotation};
  }
  Vector3 operator*(const Vector3& p) const { return rotation * p + translation; }

  Pose Inverse() const {
    const Eigen::Quaternion<T> inverse = rotation.conjugate();
    return {-(inverse * translation), inverse};
  }

  template <typename U>
  Pose<U> Cast() const {
    return {translation.template cast<U>(), rotation.template cast<U>()};
  }

  Eigen::Matrix<T, 4, 4> Matrix() const {
    Eigen::Matrix<T, 4, 4> m = Eigen::Matrix<T, 4, 4>::Identity();
    m.template topLeftCorner<3, 3>() = rotation.toRotationMatrix();
    m.template topRightCorner<3, 1>() = translation;
    return m;
  }
};

using Pose3d = Pose<double>;

template <typename T>
Pose<T> Plus(const Pose<T>& x, const Eigen::Matrix<T, 6, 1>& d) {
  const Eigen::Matrix<T, 3, 1> turn = d.template tail<3>();
  return {x.translation + x.rotation * Eigen::Matrix<T, 3, 1>(d.template head<3>()),
          (x.rotation * Exp(turn)).normalized()};
}

// The d with x [+] d = y; its rotation is at most pi long.
template <typename T>
Eigen::Matrix<T, 6, 1> Minus(const Pose<T>& y, const Pose<T>& x) {
  const Eigen::Quaternion<T> inverse = x.rotation.conjugate();
  Eigen::Matrix<T, 6, 1> d;
  d.template head<3>() = inverse * Eigen::Matrix<T, 3, 1>(y.translation - x.translation);
  d.template tail<3>() = Log(Eigen::Quaternion<T>(inverse * y.rotation));
  return d;
}

// Pose of a rotation matrix (orthonormal to rounding) and a translation.
inline Pose3d MakePose(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& translation) {
  return {translation, Eigen::Quaterniond(rotation).normalized()};
}

// The 6x6 matrix that carries a small right motion of a_from_b to the right of a_from_b * b_from_c:
//   (a_from_b [+] d) * b_from_c  =  (a_from_b * b_from_c) [+] (InverseAdjoint(b_from_c) d),  to
//   first order.
// It is [R' , -R' [t]x ; 0 , R'] and the left half of the paper's Jacobian, [R_u C_u; 0 R_u] of Eq.
// (20).
Matrix6d InverseAdjoint(const Pose3d& b_from_c);

// Inverse of the left Jacobian of Exp at the rotation vector v:
//   Log(Exp(d) Exp(v)) = v + LeftJacobianInverse(v) d + O(d^2).
Eigen::Matrix3d LeftJacobianInverse(const Eigen::Vector3d& v);

// Right Jacobian of Exp at the rotation vector v:
//   Exp(v + d) = Exp(v) Exp(RightJacobian(v) d + O(d^2)).
Eigen::Matrix3d RightJacobian(const Eigen::Vector3d& v);

}  // namespace hexcal
