// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/error_length.h"

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <limits>

#include "estimator/quantiles.h"
#include "geometry/linear_algebra.h"

namespace hexcal {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
constexpr int kNodes = 30;     // along the longest axis
constexpr int kAzimuths = 12;  // around it, of a quarter turn
constexpr double kQuarterTurn = 1.5707963267948966;
constexpr double kDimensions = 3.0;
// Beyond this F is chi-square to all digits that matter.
constexpr double kMany = 1e6;
constexpr int kDigits = 36;  // binary, of a quantile
constexpr std::uintmax_t kMostSteps = 60;

// Variances along the principal axes, the largest first, none negative.
Eigen::Vector3d Variances(const Eigen::Matrix3d& covariance) {
  return DecomposeSymmetric(covariance).values.reverse().cwiseMax(0.0);
}

// That three squares exceed x in units of their variance.
double SquaresTail(double x, double dof) {
  return dof < kMany ? FisherFTail(x / kDimensions, kDimensions, dof)
                     : ChiSquareTail(x, kDimensions);
}

double Tail(const Eigen::Vector3d& variances, double length, double dof) {
  using Gauss = boost::math::quadrature::gauss<double, kNodes>;
  // The longest axis is the pole of the sphere; one eighth of it stands for all.
  const auto ring = [&](double cosine) {
    double sum = 0.0;
    for (int k = 0; k < kAzimuths; ++k) {
      const double c = std::cos((k + 0.5) / kAzimuths * kQuarterTurn);
      const double across = variances[1] * c * c + variances[2] * (1.0 - c * c);
      const double along = cosine * cosine * variances[0] + (1.0 - cosine * cosine) * across;
      if (along > 0.0) sum += SquaresTail(length * length / along, dof);
    }
    return sum / kAzimuths;
  };
  return Gauss::integrate(ring, 0.0, 1.0);
}

}  // namespace

double LengthTail(const Eigen::Matrix3d& covariance, double length, double degrees_of_freedom) {
  if (!covariance.allFinite()) return kUnknown;
  return Tail(Variances(covariance), length, degrees_of_freedom);
}

double LengthQuantile(const Eigen::Matrix3d& covariance,
                      double probability,
                      double degrees_of_freedom) {
  if (!covariance.allFinite()) return kUnknown;
  const Eigen::Vector3d variances = Variances(covariance);
  if (!(variances[0] > 0.0)) return 0.0;
  // In units of the longest axis; the ends are those of an error on a line and of one that is the
  // same in all directions, with some room.
  const Eigen::Vector3d relative = variances / variances[0];
  const auto excess = [&](double length) {
    return Tail(relative, length, degrees_of_freedom) - (1.0 - probability);
  };
  double low = 0.5, high = 4.0;
  while (excess(low) < 0.0) low *= 0.5;
  while (excess(high) > 0.0) high *= 2.0;
  std::uintmax_t steps = kMostSteps;
  const auto [a, b] = boost::math::tools::toms748_solve(
      excess, low, high, boost::math::tools::eps_tolerance<double>(kDigits), steps);
  return 0.5 * (a + b) * std::sqrt(variances[0]);
}

}  // namespace hexcal
