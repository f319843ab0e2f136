// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "estimator/pivot_fit.h"

namespace hexcal {

struct PivotOptions {
  // A direction of the tool is lost where the poses tilt it by less than this many times what their
  // orientation noise does, or than numbers in files resolve.
  double least_tilt_to_noise = 4.0;
  double least_tilt = 1e-6;  // rad
  // The probability that poses without any outlier list one or more; in (0, 1).
  double alpha = 0.01;
  bool reject_outliers = false;  // else they are listed and used
};

// The fit to some of the poses, with what was not known of their noise.
struct PivotSolution {
  PivotFit fit;
  Tilts tilts;                                            // of the fitted poses
  Eigen::Vector3d noise_tilts = Eigen::Vector3d::Zero();  // of tilts.directions, by noise, rad
  std::array<bool, 3> is_lost = {};  // of tilts.directions: the tip is not determined along it
  double noise_scale = 1.0;          // kUpToScale: the factor of the sigmas
  // kUnknown: one sigma of a coordinate, m, and about an axis, rad. (What turns about the tip do is
  // not seen; where the two cannot be told apart, all of it is position.)
  double position_noise = 0.0, orientation_noise = 0.0;
  Matrix6d covariance = Matrix6d::Zero();  // fit.covariance, and what unknown noise adds to it
  // With which the variances of (tip, pivot) are known, and that of the tip at once; infinite where
  // the noise is.
  Vector6d degrees_of_freedom = Vector6d::Zero();
  double tip_degrees_of_freedom = 0.0;
};

// used: the fitted poses, three or more. Unknown noise is estimated by variance components, so that
// the fitted parameters do not make it too small (the restricted likelihood). References: W.
// Foerstner, Zeitschrift fuer Vermessungswesen 104 (1979); M. G. Kenward, J. H. Roger, Biometrics
// 53 (1997).
PivotSolution SolvePivot(const PivotPoses& poses,
                         const std::vector<bool>& used,
                         const PivotOptions& options);

// The directions in which a tip can be sought: orthonormal to what is lost, 3 x (3 - lost).
Eigen::Matrix3Xd ComplementOf(const Tilts& tilts, const std::array<bool, 3>& is_lost);

}  // namespace hexcal
