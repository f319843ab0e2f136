// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "estimator/variances.h"
#include "residuals/pose_error.h"

namespace hexcal {

// How far the true parameters may be off with a probability of 95 %.
struct Intervals {
  Vector12d half_width = Vector12d::Zero();  // of each parameter alone, m and rad
  // With which each standard deviation is known: infinite where the noise is.
  Vector12d degrees_of_freedom = Vector12d::Zero();
  // All 12 at once: d' covariance^-1 d <= ellipsoid for the difference d of estimate and truth.
  double ellipsoid = 0.0;

  // For other numbers than the 12. The covariance with what the weights' own error adds; where the
  // noise was estimated, its slope by each of the variances and their covariance (else empty).
  Matrix12d widened = Matrix12d::Zero();
  std::vector<Matrix12d> slopes;
  Eigen::MatrixXd spread;
};

// The same of one number: a mix of the 12 by `weights`.
struct NumberInterval {
  double half_width = 0.0, degrees_of_freedom = 0.0;
};
NumberInterval IntervalOf(const Intervals& intervals,
                          const Matrix12d& covariance,
                          const Vector12d& weights);

// The noise is known: the normal and the chi-square distribution.
Intervals IntervalsOfKnownNoise(const Matrix12d& covariance);

// The noise was estimated by REML from the residuals, components being its parts. Few poses tell
// few levels: Kenward and Roger, Biometrics 53 (1997): the covariance is widened by what the
// weights' own error adds, t and F have degrees of freedom by the spread of the levels
// (Satterthwaite's for a single parameter).
Intervals IntervalsOfEstimatedNoise(const Matrix12d& covariance,
                                    const std::vector<VarianceComponent>& components,
                                    const Variances& variances);

// The same where all that is known of the levels is the residuals' degrees of freedom.
Intervals IntervalsOfScaledNoise(const Matrix12d& covariance, double degrees_of_freedom);

}  // namespace hexcal
