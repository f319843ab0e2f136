// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "geometry/pose.h"

namespace hexcal {

// A smooth correction of the platform for which no cause is known: a polynomial in the reported
// pose. It is a description of what was measured, so it is never extrapolated.
struct PoseMap {
  int degree = 1;    // 1 or 2
  Pose3d reference;  // coordinates of a pose are base_from_platform [-] reference, [m, rad]
  // The box of coordinates that it was fitted in; terms are powers of (coordinate - centre) /
  // half_width. A coordinate of half-width zero has no terms but zeros.
  Vector6d centre = Vector6d::Zero(), half_width = Vector6d::Ones();
  Eigen::MatrixXd coefficients;  // 6 x terms: the twist's six numbers by term, m and rad
};

// 1, then the 6 coordinates, then of degree 2 the 21 products (1 1), (1 2) ... (6 6).
int PoseMapTermCount(int degree);

// The terms at a pose, normalised, in that order. Outside the box: those of its nearest point.
Eigen::VectorXd PoseMapTerms(const PoseMap& map, const Pose3d& base_from_platform);

// Right twist of base_from_platform: where the platform really is, from where it is reported.
Vector6d PoseMapTwist(const PoseMap& map, const Pose3d& base_from_platform);

}  // namespace hexcal
