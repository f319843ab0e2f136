// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/chordal_cost.h"

namespace hexcal {

void ChordalCost::Add(const Observation& observation, double position, double orientation) {
  if (is_empty_) {
    first_q_ = observation.world_from_tool.translation;
    first_a_ = observation.base_from_platform.translation;
    is_empty_ = false;
  }
  const Eigen::Matrix3d turn = observation.base_from_platform.rotation.toRotationMatrix();
  const Eigen::Matrix3d measured = observation.world_from_tool.rotation.toRotationMatrix();
  const Eigen::Vector3d q = observation.world_from_tool.translation - first_q_;
  const Eigen::Vector3d a = observation.base_from_platform.translation - first_a_;
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 3; ++i)
      q_x_a_.block<3, 3>(3 * i, 3 * j) += orientation * measured(i, j) * turn;
    shift_x_a_.middleRows<3>(3 * j) += position * q[j] * turn;
  }
  const Eigen::Vector3d weighted_q = position * q, weighted_a = position * a;
  shift_shift_ += weighted_q * q.transpose();
  robot_shift_ += weighted_a * q.transpose();
  turn_ += position * turn;
  shift_ += weighted_q;
  robot_ += weighted_a;
  turned_robot_ += turn.transpose() * weighted_a;
  robot_squared_ += weighted_a.dot(a);
  orientation_ += orientation;
  position_ += position;
}

Eigen::MatrixXd ChordalCost::Form() const {
  constexpr int kR = 9, kT = 18, kC = 21, kOne = 24;
  const Eigen::Matrix3d identity = Eigen::Matrix3d::Identity();
  Eigen::MatrixXd form = Eigen::MatrixXd::Zero(kSize, kSize);
  // |A R - Z Q|^2 / 2 = (|R|^2 + |Z|^2) / 2 - tr(R' A' Z Q), and likewise for the positions.
  form.diagonal().head<kRotations>().setConstant(0.5 * orientation_);
  form.block<9, 9>(0, kR) = -0.5 * q_x_a_;
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 3; ++i) form.block<3, 3>(3 * i, 3 * j) += shift_shift_(i, j) * identity;
    form.block<3, 3>(3 * j, kT) = -shift_x_a_.middleRows<3>(3 * j);
    form.block<3, 3>(3 * j, kC) = -shift_[j] * identity;
    form.block<3, 1>(3 * j, kOne) = -robot_shift_.col(j);
  }
  form.block<3, 3>(kT, kT) = position_ * identity;
  form.block<3, 3>(kT, kC) = turn_.transpose();
  form.block<3, 1>(kT, kOne) = turned_robot_;
  form.block<3, 3>(kC, kC) = position_ * identity;
  form.block<3, 1>(kC, kOne) = robot_;
  form(kOne, kOne) = robot_squared_;
  form.triangularView<Eigen::StrictlyLower>() = form.transpose();
  return form;
}

}  // namespace hexcal
