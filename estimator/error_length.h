// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace hexcal {

// How long an error in space is whose three coordinates have this covariance, m^2, and mean zero.
// degrees_of_freedom: with which the covariance is known (infinite: exactly; else the error follows
// a multivariate t). A covariance of less than full rank will do.
//
// z of e = root(covariance) z has a direction d, uniform on the sphere, and a length of its own, so
// that |e|^2 = (d' covariance d) |z|^2, and the probability is the mean of a chi-square (or F) tail
// over all directions: a smooth integral, done by Gauss and trapezoidal rules to 1e-6 or better.

// The probability that the error is longer than length, m, above 0.
double LengthTail(const Eigen::Matrix3d& covariance, double length, double degrees_of_freedom);

// The length, m, that it stays below with this probability, in (0, 1). 0 where there is no error.
// NaN, as the tail is, for a covariance that is not finite.
double LengthQuantile(const Eigen::Matrix3d& covariance,
                      double probability,
                      double degrees_of_freedom);

}  // namespace hexcal
