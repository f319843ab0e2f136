// SPDX-License-Identifier: BSD-3-Clause
#include "hidden/motion.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace hexcal::hidden {
namespace {

Eigen::Matrix3d CrossMatrix(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

}  // namespace

Motion operator*(const Motion& a_from_b, const Motion& b_from_c) {
  return {a_from_b.turn * b_from_c.turn, a_from_b.turn * b_from_c.shift + a_from_b.shift};
}

Eigen::Vector3d operator*(const Motion& a_from_b, const Eigen::Vector3d& x_in_b) {
  return a_from_b.turn * x_in_b + a_from_b.shift;
}

Motion Inverse(const Motion& a_from_b) {
  return {a_from_b.turn.transpose(), -(a_from_b.turn.transpose() * a_from_b.shift)};
}

Eigen::Matrix3d TurnBy(const Eigen::Vector3d& rotation_vector) {
  const double angle = rotation_vector.norm();
  const Eigen::Matrix3d k = CrossMatrix(rotation_vector);
  // sin(a)/a and (1 - cos a)/a^2 by their series where the quotients would lose digits.
  const double a2 = angle * angle;
  const double s = angle < 1e-4 ? 1.0 - a2 / 6.0 : std::sin(angle) / angle;
  const double half = std::sin(0.5 * angle);
  const double c = angle < 1e-4 ? 0.5 - a2 / 24.0 : 2.0 * half * half / a2;
  return Eigen::Matrix3d::Identity() + s * k + c * k * k;
}

Eigen::Vector3d RotationVector(const Eigen::Matrix3d& turn) {
  const Eigen::Vector4d q = QuaternionOf(turn);
  const double sine = q.tail<3>().norm();
  if (sine < 1e-8) return 2.0 * q.tail<3>();
  return 2.0 * std::atan2(sine, q[0]) / sine * q.tail<3>();
}

Eigen::Vector4d QuaternionOf(const Eigen::Matrix3d& turn) {
  // Of the four components the largest is found first: no other choice is stable everywhere.
  Eigen::Vector4d squares;
  squares << 1 + turn.trace(), 1 + 2 * turn(0, 0) - turn.trace(), 1 + 2 * turn(1, 1) - turn.trace(),
      1 + 2 * turn(2, 2) - turn.trace();
  int largest = 0;
  squares.maxCoeff(&largest);
  Eigen::Vector4d q;
  const double d = 2.0 * std::sqrt(squares[largest]);
  q[largest] = 0.25 * d;
  const Eigen::Vector3d odd(
      turn(2, 1) - turn(1, 2), turn(0, 2) - turn(2, 0), turn(1, 0) - turn(0, 1));
  if (largest == 0) {
    q.tail<3>() = odd / d;
  } else {
    const int i = largest - 1, j = (i + 1) % 3, k = (i + 2) % 3;
    q[0] = odd[i] / d;
    q[j + 1] = (turn(i, j) + turn(j, i)) / d;
    q[k + 1] = (turn(i, k) + turn(k, i)) / d;
  }
  q.normalize();
  return q[0] < 0 ? Eigen::Vector4d(-q) : q;
}

Motion FromPoseVector(const Six& vector) {
  return {TurnBy({vector[3], 0, 0}) * TurnBy({0, vector[4], 0}) * TurnBy({0, 0, vector[5]}),
          vector.head<3>()};
}

Motion Moved(const Motion& from, const Six& twist) {
  return {from.turn * TurnBy(twist.tail<3>()), from.shift + from.turn * twist.head<3>()};
}

Six TwistBetween(const Motion& from, const Motion& to) {
  Six twist;
  twist << from.turn.transpose() * (to.shift - from.shift),
      RotationVector(from.turn.transpose() * to.turn);
  return twist;
}

}  // namespace hexcal::hidden
