// SPDX-License-Identifier: BSD-3-Clause
#include "report/global_test.h"

#include <fmt/format.h>

#include "estimator/quantiles.h"

namespace hexcal {
namespace {

constexpr double kProbability = 0.95;

std::string Verdict(const GlobalTest& test) {
  if (!test.is_stated)
    return "The noise was estimated from what is left over, so that there is nothing to test.";
  return fmt::format(
      "Expected with 95 %: {:.5g} to {:.5g}. {}",
      test.low,
      test.high,
      test.is_too_large   ? "There is more than the stated noise explains: the noise is larger, or "
                            "the model misses something (hexcal discover looks for it)."
      : test.is_too_small ? "There is less: the stated noise is too large, and so are the "
                            "uncertainties."
                          : "The residuals agree with the stated noise.");
}

}  // namespace

GlobalTest GlobalTestOf(const Estimate& estimate) {
  GlobalTest test;
  test.is_stated = !estimate.noise.estimated;
  test.tested = estimate.OfNoise();
  test.is_of_fit = !estimate.least_squares;
  const double dof = test.tested.degrees_of_freedom;
  test.low = ChiSquareQuantile(0.5 * (1.0 - kProbability), dof);
  test.high = ChiSquareQuantile(0.5 * (1.0 + kProbability), dof);
  test.is_too_large = test.is_stated && test.tested.chi_square > test.high;
  test.is_too_small = test.is_stated && test.tested.chi_square < test.low;
  return test;
}

std::string GlobalTestText(const GlobalTest& test,
                           const ResultHeader& header,
                           const Estimate& estimate) {
  if (test.is_rounding)
    return "Here " + std::string(kOnlyRounding) +
           ". No statistic of what is left over is tested, and the uncertainty of the calibration "
           "is that of the arithmetic alone.";
  const std::string of_tested =
      fmt::format("{:.5g} with {} degrees of freedom (noise scale, or Birge ratio, {:.3f})",
                  test.tested.chi_square,
                  test.tested.degrees_of_freedom,
                  test.tested.Scale());
  if (test.is_of_fit)
    return fmt::format("Chi-square of what is left over: {}. {}", of_tested, Verdict(test));
  return fmt::format(
      "Sum of squares that this fit leaves, {}: {:.5g}; it has no chi-square distribution and is "
      "not tested. Chi-square of what least squares leaves of all {} poses{}, each by its noise "
      "alone: {}. {}",
      header.loss.kind == LossKind::kNone ? "with its equal weights" : "weighted by the loss",
      estimate.chi_square,
      (test.tested.degrees_of_freedom + 12 - estimate.observability.null_directions) / 6,
      header.loss.kind == LossKind::kNone ? "" : ", none weighted down",
      of_tested,
      Verdict(test));
}

std::string GlobalTestLines(const GlobalTest& test, const Estimate& estimate) {
  if (test.is_rounding) return "  chi-square     not tested: " + std::string(kOnlyRounding) + "\n";
  std::string text;
  if (!test.is_of_fit)
    text += fmt::format("  left over      {:.5g}, the weighted sum of squares: not tested\n",
                        estimate.chi_square);
  return text + fmt::format("  chi-square     {:.5g} with {} degrees of freedom{}{}\n",
                            test.tested.chi_square,
                            test.tested.degrees_of_freedom,
                            test.is_of_fit ? "" : ", by least squares, none weighted down",
                            !test.is_stated     ? " (noise estimated: nothing to test)"
                            : test.is_too_large ? ": more than the stated noise explains"
                            : test.is_too_small ? ": less than the stated noise"
                                                : ": as the stated noise explains");
}

}  // namespace hexcal
