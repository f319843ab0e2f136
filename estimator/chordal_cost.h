// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "estimator/observations.h"

namespace hexcal {

// Eq. (1) in the base's axes is linear in the entries of both rotations and in both translations:
//   Z Q = A R,   Z q - b = a + A t;   Z = R_base', b = Z t_base; R, t: the tool; Q, q: measured;
//                                     A, a: reported.
// So the weighted sum of its squared misfits,
//   sum of  orientation/2 |A R - Z Q|^2 (Frobenius) + position |Z q - b - a - A t|^2,
// is a quadratic form of v = [vec Z, vec R, t, c, 1], vec by columns; c is b as the first pose sees
// it, so that nothing is lost where the tracker stands far away. |A R - Z Q|^2 / 2 is the angle
// squared, less a twelfth of its fourth power: with weights 1/sigma^2 the sum is a chi-square. All
// that is kept of the poses is the form. After A. Li, L. Wang, D. Wu, Int. J. Physical Sciences 5
// (2010), and E. Wise et al., arXiv 2507.23045.
class ChordalCost {
 public:
  static constexpr int kRotations = 18;  // leading entries of v
  static constexpr int kSize = 25;

  // Weights: of a coordinate, 1/m^2, and of an angle, 1/rad^2.
  void Add(const Observation& observation, double position, double orientation);

  // 25 x 25, both triangles: the sum is v' Form() v.
  Eigen::MatrixXd Form() const;

  // Sum of the orientation weights: what the form's entries are of the size of.
  double orientation() const { return orientation_; }

  // b of c, with this Z.
  Eigen::Vector3d BaseShift(const Eigen::Matrix3d& z, const Eigen::Vector3d& c) const {
    return c + z * first_q_ - first_a_;
  }

 private:
  bool is_empty_ = true;
  Eigen::Vector3d first_q_ = Eigen::Vector3d::Zero(), first_a_ = Eigen::Vector3d::Zero();
  double orientation_ = 0.0, position_ = 0.0;
  // Weighted sums of products; (x): Kronecker.
  Eigen::Matrix<double, 9, 9> q_x_a_ = Eigen::Matrix<double, 9, 9>::Zero();      // Q (x) A
  Eigen::Matrix<double, 9, 3> shift_x_a_ = Eigen::Matrix<double, 9, 3>::Zero();  // q (x) A
  Eigen::Matrix3d shift_shift_ = Eigen::Matrix3d::Zero();                        // q q'
  Eigen::Matrix3d robot_shift_ = Eigen::Matrix3d::Zero();                        // a q'
  Eigen::Matrix3d turn_ = Eigen::Matrix3d::Zero();                               // A
  Eigen::Vector3d shift_ = Eigen::Vector3d::Zero();                              // q
  Eigen::Vector3d robot_ = Eigen::Vector3d::Zero();                              // a
  Eigen::Vector3d turned_robot_ = Eigen::Vector3d::Zero();                       // A' a
  double robot_squared_ = 0.0;                                                   // a' a
};

}  // namespace hexcal
