// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "geometry/pose.h"

namespace hexcal {

// a_from_b and its covariance as a right perturbation, [m, rad].
struct Alignment {
  Pose3d a_from_b;
  Matrix6d covariance = Matrix6d::Zero();
  double chi_square = 0.0;  // sum of squared whitened misfits, 3n - 6 degrees of freedom
};

// How near to collinear points are: the middle singular value of the centred points, m (0:
// collinear, or all in one place). Shape: 3 x n.
double PlanarSpread(const Eigen::Matrix3Xd& points);

// The rotation nearest to m in the Frobenius norm (m may be any real 3x3 matrix; a reflection is
// never returned).
Eigen::Matrix3d NearestRotation(const Eigen::Matrix3d& m);

// Least-squares rigid motion with equal weights (Umeyama 1991, without scale): p_in_a ~ a_from_b *
// p_in_b. Shapes 3 x n, n >= 3 and not collinear.
Pose3d AlignPoints(const Eigen::Matrix3Xd& p_in_a, const Eigen::Matrix3Xd& p_in_b);

// Weighted fit: column k of sigma_in_a holds the 1-sigma of p_in_a's three coordinates, m.
// Gauss-Newton from the equal-weight fit; the covariance is the inverse normal matrix.
Alignment AlignPointsWeighted(const Eigen::Matrix3Xd& p_in_a,
                              const Eigen::Matrix3Xd& p_in_b,
                              const Eigen::Matrix3Xd& sigma_in_a);

}  // namespace hexcal
