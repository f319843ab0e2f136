// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "residuals/pose_pass.h"

namespace hexcal {

using Matrix9d = Eigen::Matrix<double, 9, 9>;

// Sums over poses of products of what was reported (A, a: base_from_platform) and measured (Q, q:
// world_from_tool). They know no base and no tool, so that one pass serves every choice of these:
// with rotations compared by their entries, the squares of what Eq. (1) leaves over are made of
// them. Translations, m, from those of the batch's first pose, so that nothing is lost where the
// tracker stands far away.
struct PoseMoments {
  Eigen::Vector3d first_q = Eigen::Vector3d::Zero(), first_a = Eigen::Vector3d::Zero();
  double poses = 0.0;
  Matrix9d turns = Matrix9d::Zero();                   // A_ij Q_kl: row 3i + j, column 3k + l
  Eigen::Matrix3d reported = Eigen::Matrix3d::Zero();  // A
  Eigen::Matrix3d measured = Eigen::Matrix3d::Zero();  // Q
  Eigen::Matrix3d q_reported[3] = {reported, reported, reported};  // q_k A
  Eigen::Matrix3d qq = Eigen::Matrix3d::Zero();                    // q q'
  Eigen::Matrix3d qa = Eigen::Matrix3d::Zero();                    // q a'
  Eigen::Vector3d reported_a = Eigen::Vector3d::Zero();            // A' a
  Eigen::Vector3d q = Eigen::Vector3d::Zero(), a = Eigen::Vector3d::Zero();
  double aa = 0.0;  // a' a

  void Add(const PoseMoments& other);
};

// mounts and weights of the input have no part in it.
PoseMoments PassMoments(const PassInput& input,
                        const Eigen::Vector3d& first_q,
                        const Eigen::Vector3d& first_a);

}  // namespace hexcal
