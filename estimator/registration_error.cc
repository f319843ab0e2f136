// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/registration_error.h"

#include <cmath>

#include "geometry/linear_algebra.h"

namespace hexcal {

double FiducialRegistrationError(Eigen::Index markers, double sigma) {
  return sigma * std::sqrt(3.0 * (1.0 - 2.0 / static_cast<double>(markers)));
}

double TargetRegistrationError(const Eigen::Matrix3Xd& p_in_body,
                               double sigma,
                               const Eigen::Vector3d& target_in_body) {
  const double n = static_cast<double>(p_in_body.cols());
  const Eigen::Vector3d centroid = p_in_body.rowwise().mean();
  const Eigen::Matrix3Xd centred = p_in_body.colwise() - centroid;
  // Columns of the eigenvectors are the principal axes.
  const Eigen::Matrix3d axes = DecomposeSymmetric(centred * centred.transpose()).vectors;
  const Eigen::Matrix3Xd along = axes.transpose() * centred;
  const Eigen::Vector3d target = axes.transpose() * (target_in_body - centroid);
  double ratios = 0.0;  // squared distances from each axis, the target's to the markers' mean
  for (int k = 0; k < 3; ++k) {
    const double markers = (along.squaredNorm() - along.row(k).squaredNorm()) / n;
    ratios += (target.squaredNorm() - target[k] * target[k]) / markers;
  }
  return sigma * std::sqrt(3.0 / n * (1.0 + ratios / 3.0));
}

}  // namespace hexcal
