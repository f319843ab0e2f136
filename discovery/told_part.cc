// SPDX-License-Identifier: BSD-3-Clause
#include "discovery/told_part.h"

#include <algorithm>
#include <cmath>

#include "geometry/linear_algebra.h"

namespace hexcal {

// In units of the prior, its precision is 1 along every direction. Along an eigenvector of the
// posterior covariance, with the variance v, the data's own precision is 1/v - 1 then, and the
// posterior mean the data's times 1 - v.
ToldPart ToldPartOf(const JointFit& fit, const Eigen::VectorXd& prior, int at_least) {
  const Eigen::Index size = fit.coefficients.size(), mounts = fit.mounts.size();
  const Eigen::MatrixXd covariance = prior.cwiseInverse().asDiagonal() *
                                     fit.covariance.bottomRightCorner(size, size) *
                                     prior.cwiseInverse().asDiagonal();
  const Eigenvalues eigen = DecomposeSymmetric(covariance);
  const Eigen::MatrixXd directions = prior.asDiagonal() * eigen.vectors;
  const Eigen::VectorXd along =
      eigen.vectors.transpose() * prior.cwiseInverse().asDiagonal() * fit.coefficients;
  ToldPart part;
  part.directions = static_cast<int>(size);
  while (part.told < size &&
         (eigen.values[part.told] <= kToldVariance || part.told < at_least))  // smallest first
    ++part.told;
  part.coefficients = Eigen::VectorXd::Zero(size);
  part.root.setZero(size, part.told);
  for (int k = 0; k < part.told; ++k) {
    const double variance = std::clamp(eigen.values[k], 0.0, 1.0 - 1e-9);
    part.coefficients += directions.col(k) * (along[k] / (1.0 - variance));
    part.root.col(k) = directions.col(k) * std::sqrt(variance / (1.0 - variance));
  }
  const Eigen::MatrixXd inverse = prior.cwiseInverse().asDiagonal() * eigen.vectors *
                                  eigen.values.cwiseInverse().asDiagonal() *
                                  eigen.vectors.transpose() * prior.cwiseInverse().asDiagonal();
  part.response = fit.covariance.topRightCorner(mounts, size) * inverse;
  return part;
}

}  // namespace hexcal
