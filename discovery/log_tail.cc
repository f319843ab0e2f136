// SPDX-License-Identifier: BSD-3-Clause
#include "discovery/log_tail.h"

#include <cmath>

#include "estimator/quantiles.h"

namespace hexcal {
namespace {

constexpr double kPlain = 1e-200;  // above it the library's own tail has all digits

}  // namespace

double Log10FisherTail(double f, double numerator_dof, double denominator_dof) {
  if (!(f > 0.0)) return 0.0;
  const double tail = FisherFTail(f, numerator_dof, denominator_dof);
  if (tail > kPlain) return std::log10(tail);
  // The tail is the incomplete beta function I_x(a, b), here by its power series in x
  // (Abramowitz and Stegun 26.5.4), which converges fast for small x.
  const double a = 0.5 * denominator_dof, b = 0.5 * numerator_dof;
  const double x = denominator_dof / (denominator_dof + numerator_dof * f);
  double term = 1.0, sum = 1.0;
  for (int n = 0; n < 10000; ++n) {
    term *= x * (a + b + n) / (a + 1.0 + n);
    sum += term;
    if (term < 1e-12 * sum) break;
  }
  const double log_tail = a * std::log(x) + b * std::log1p(-x) - std::log(a) + std::lgamma(a + b) -
                          std::lgamma(a) - std::lgamma(b) + std::log(sum);
  return log_tail / std::log(10.0);
}

}  // namespace hexcal
