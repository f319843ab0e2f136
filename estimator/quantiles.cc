// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/quantiles.h"

#include <boost/math/distributions/beta.hpp>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/non_central_chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>

namespace hexcal {
namespace {

// Doubles throughout (long ones take three times as long), and no exception where a tail is too
// small for a number, nor where there is no distribution (NaN): a fit of exact data to a wrong
// model may leave no degree of freedom.
using Policy = boost::math::policies::policy<
    boost::math::policies::promote_double<false>,
    boost::math::policies::domain_error<boost::math::policies::ignore_error>,
    boost::math::policies::overflow_error<boost::math::policies::ignore_error>,
    boost::math::policies::underflow_error<boost::math::policies::ignore_error>>;
using StudentT = boost::math::students_t_distribution<double, Policy>;
using ChiSquare = boost::math::chi_squared_distribution<double, Policy>;
using FisherF = boost::math::fisher_f_distribution<double, Policy>;

template <typename Distribution>
double Tail(const Distribution& distribution, double x) {
  return boost::math::cdf(boost::math::complement(distribution, x));
}

// Of a statistic that cannot be negative. What comes of numbers that somebody changed may be
// anything: then there is no probability, where Boost throws.
template <typename Distribution>
double TailOfSquare(const Distribution& distribution, double x) {
  if (!(x >= 0.0)) return std::numeric_limits<double>::quiet_NaN();
  return std::isinf(x) ? 0.0 : Tail(distribution, x);
}

}  // namespace

double NormalQuantile(double probability) {
  return boost::math::quantile(boost::math::normal_distribution<double, Policy>(), probability);
}

double BetaQuantile(double probability, double a, double b) {
  return boost::math::quantile(boost::math::beta_distribution<double, Policy>(a, b), probability);
}

double StudentTQuantile(double probability, double degrees_of_freedom) {
  return boost::math::quantile(StudentT(degrees_of_freedom), probability);
}

double StudentTTail(double x, double degrees_of_freedom) {
  return Tail(StudentT(degrees_of_freedom), x);
}

double ChiSquareQuantile(double probability, double degrees_of_freedom) {
  return boost::math::quantile(ChiSquare(degrees_of_freedom), probability);
}

double ChiSquareTail(double x, double degrees_of_freedom) {
  return TailOfSquare(ChiSquare(degrees_of_freedom), x);
}

double ChiSquareNoncentrality(double alpha, double power, double degrees_of_freedom) {
  using Noncentral = boost::math::non_central_chi_squared_distribution<double, Policy>;
  return Noncentral::find_non_centrality(boost::math::complement(
      degrees_of_freedom,
      boost::math::quantile(boost::math::complement(ChiSquare(degrees_of_freedom), alpha)),
      power));
}

double FisherFQuantile(double probability, double numerator_dof, double denominator_dof) {
  return boost::math::quantile(FisherF(numerator_dof, denominator_dof), probability);
}

double FisherFTail(double x, double numerator_dof, double denominator_dof) {
  return TailOfSquare(FisherF(numerator_dof, denominator_dof), x);
}

double FisherFDensity(double x, double numerator_dof, double denominator_dof) {
  return boost::math::pdf(FisherF(numerator_dof, denominator_dof), x);
}

BinomialInterval ClopperPearson(long successes, long trials, double confidence) {
  const auto n = static_cast<double>(trials), k = static_cast<double>(successes);
  const double tail = 0.5 * (1.0 - confidence);
  return {successes == 0 ? 0.0 : BetaQuantile(tail, k, n - k + 1.0),
          successes == trials ? 1.0 : BetaQuantile(1.0 - tail, k + 1.0, n - k)};
}

// With half = x / 2: {A < half, B > x - A}, {B < half, A > x - B} and {A > half, B > half} are all
// of it and do not overlap. The integrals over the smaller one by Simpson's rule in its logarithm,
// in which the integrand is smooth.
double FisherSumTail(double x, double n, double a, double b) {
  constexpr int kIntervals = 96;
  constexpr double kSmallest = 1e-6;  // below it F has no mass that counts
  const double half = 0.5 * x;
  const auto tail = [n](double value, double dof) { return FisherFTail(value / n, n, dof); };
  if (!(half > kSmallest)) return 1.0;
  const double step = std::log(half / kSmallest) / kIntervals;
  const auto part = [&](double of_smaller, double of_larger) {
    double sum = 0.0;
    for (int i = 0; i <= kIntervals; ++i) {
      const double smaller = kSmallest * std::exp(i * step);
      const double weight = i == 0 || i == kIntervals ? 1.0 : i % 2 == 1 ? 4.0 : 2.0;
      sum += weight * smaller * FisherFDensity(smaller / n, n, of_smaller) / n *
             tail(x - smaller, of_larger);
    }
    return sum * step / 3.0;
  };
  return part(a, b) + part(b, a) + tail(half, a) * tail(half, b);
}

}  // namespace hexcal
