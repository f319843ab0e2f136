// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "estimator/covariance.h"
#include "estimator/observations.h"

namespace hexcal {

// How far a pose is off what the other poses of a fit predict for it, [m, rad] in frame T, and the
// covariance of that: its own noise and the prediction's.
struct DeletionError {
  Vector6d error;
  Matrix6d covariance;

  double Squared() const;  // error' covariance^-1 error: chi-square with 6 degrees of freedom
  double SigmasOf(int first) const;  // the root of the same for three: 0 position, 3 orientation
};

// at_fit: error and Jacobian at mounts that were fitted with the covariance fit_covariance; noise:
// the covariance of this pose's error. A pose of the fit has residuals of covariance S = noise - J
// fit_covariance J', and without it its error would be noise S^-1 e; one that was left out is off
// by e itself. Either is exact where the fit is linear. Nothing where without the pose some
// direction would not be determined. Reference: R. D. Cook, S. Weisberg, Residuals and Influence in
// Regression (1982), sec. 2.2.
std::optional<DeletionError> ErrorAgainstOthers(const LinearisedError& at_fit,
                                                const Matrix6d& noise,
                                                const Matrix12d& fit_covariance,
                                                bool is_in_fit);

// The same of any fit: of_fit is the covariance of its prediction, J fit_covariance J'.
std::optional<DeletionError> ErrorWithout(const Vector6d& error,
                                          const Matrix6d& noise,
                                          const Matrix6d& of_fit);

}  // namespace hexcal
