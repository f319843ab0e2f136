// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/quantiles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <utility>

#include "testing/random.h"

namespace hexcal {
namespace {

// The tables at the back of every textbook, and closed forms: t with 2 degrees of freedom has the
// tail (1 - x / sqrt(2 + x^2)) / 2, chi-square with 6 has exp(-x/2) (1 + x/2 + x^2/8), F with 2
// and d has (1 + 2 x / d)^(-d/2).
TEST(Quantiles, AreThoseOfTables) {
  EXPECT_NEAR(StudentTQuantile(0.975, 10.0), 2.228, 5e-4);
  EXPECT_NEAR(StudentTQuantile(0.975, 48.0), 2.011, 5e-4);
  EXPECT_NEAR(ChiSquareQuantile(0.95, 12.0), 21.026, 5e-4);
  EXPECT_NEAR(ChiSquareQuantile(0.99, 6.0), 16.812, 5e-4);
  EXPECT_NEAR(FisherFQuantile(0.95, 6.0, 10.0), 3.217, 5e-4);
  EXPECT_NEAR(FisherFQuantile(0.99, 3.0, 20.0), 4.938, 5e-4);
}

// The smallest of n evenly spread numbers is beta (1, n), the largest beta (n, 1).
TEST(Quantiles, OfNormalAndBetaAreTableAndClosedForm) {
  EXPECT_NEAR(NormalQuantile(0.975), 1.959963984540054, 1e-14);
  EXPECT_NEAR(NormalQuantile(1e-10), -6.361340902404056, 1e-11);
  for (const double p : {0.025, 0.5, 0.975}) {
    EXPECT_NEAR(BetaQuantile(p, 1.0, 40.0), 1.0 - std::pow(1.0 - p, 1.0 / 40.0), 1e-14);
    EXPECT_NEAR(BetaQuantile(p, 40.0, 1.0), std::pow(p, 1.0 / 40.0), 1e-14);
  }
}

// An exception would end an audit of which one number cannot be said.
TEST(Quantiles, OfNoDegreeOfFreedomAreNone) {
  for (const double none : {0.0, -1.0, std::nan("")}) {
    EXPECT_TRUE(std::isnan(StudentTQuantile(0.975, none))) << none;
    EXPECT_TRUE(std::isnan(StudentTTail(1.0, none))) << none;
    EXPECT_TRUE(std::isnan(ChiSquareQuantile(0.95, none))) << none;
    EXPECT_TRUE(std::isnan(FisherFQuantile(0.95, 12.0, none))) << none;
    EXPECT_TRUE(std::isnan(FisherFTail(1.0, none, 12.0))) << none;
  }
}

double BinomialTail(int from, int n, double p) {
  double sum = 0.0;
  for (int k = from; k <= n; ++k)
    sum += std::exp(std::lgamma(n + 1.0) - std::lgamma(k + 1.0) - std::lgamma(n - k + 1.0) +
                    k * std::log(p) + (n - k) * std::log1p(-p));
  return sum;
}

// By hand where none or all succeed; else each limit leaves half of the rest to its tail.
TEST(Quantiles, BinomialLimitsLeaveHalfOfTheRestToEitherSide) {
  const BinomialInterval none = ClopperPearson(0, 10, 0.95), all = ClopperPearson(10, 10, 0.95);
  EXPECT_EQ(none.low, 0.0);
  EXPECT_NEAR(none.high, 1.0 - std::pow(0.025, 0.1), 1e-12);
  EXPECT_NEAR(all.low, std::pow(0.025, 0.1), 1e-12);
  EXPECT_EQ(all.high, 1.0);
  for (const auto& [k, n] : {std::pair{5, 10}, {50, 60}, {947, 1000}}) {
    const BinomialInterval limits = ClopperPearson(k, n, 0.9);
    EXPECT_NEAR(BinomialTail(k, n, limits.low), 0.05, 1e-9);
    EXPECT_NEAR(BinomialTail(k + 1, n, limits.high), 0.95, 1e-9);
  }
}

TEST(Quantiles, TailsAreTheClosedForms) {
  for (const double x : {0.0, 0.3, 1.0, 5.0, 40.0}) {
    EXPECT_NEAR(StudentTTail(x, 2.0), 0.5 * (1.0 - x / std::sqrt(2.0 + x * x)), 1e-15);
    EXPECT_NEAR(StudentTTail(-x, 2.0), 0.5 * (1.0 + x / std::sqrt(2.0 + x * x)), 1e-15);
    EXPECT_NEAR(FisherFTail(x, 2.0, 7.5), std::pow(1.0 + 2.0 * x / 7.5, -3.75), 1e-14);
  }
  // to their last digits, however small
  for (const double x : {1.0, 30.0, 300.0, 1200.0}) {
    const double tail = std::exp(-0.5 * x) * (1.0 + 0.5 * x + 0.125 * x * x);
    EXPECT_NEAR(ChiSquareTail(x, 6.0) / tail, 1.0, 1e-12);
  }
  EXPECT_EQ(ChiSquareTail(1e6, 6.0), 0.0);
}

// As a history's numbers may be, once somebody has changed them.
TEST(Quantiles, TailsOfWhatIsNoSquareAreNoNumber) {
  for (const double x : {-1e-300, -1.0, -HUGE_VAL, std::nan("")}) {
    EXPECT_TRUE(std::isnan(ChiSquareTail(x, 12.0))) << x;
    EXPECT_TRUE(std::isnan(FisherFTail(x, 12.0, 5.0))) << x;
  }
  EXPECT_EQ(ChiSquareTail(HUGE_VAL, 12.0), 0.0);
  EXPECT_EQ(FisherFTail(HUGE_VAL, 12.0, 5.0), 0.0);
  EXPECT_EQ(ChiSquareTail(0.0, 12.0), 1.0);
}

TEST(Quantiles, AndTailsUndoEachOther) {
  for (const double p : {0.5, 0.95, 0.999, 1.0 - 1e-6}) {
    EXPECT_NEAR(StudentTTail(StudentTQuantile(p, 7.5), 7.5), 1.0 - p, 1e-12);
    EXPECT_NEAR(ChiSquareTail(ChiSquareQuantile(p, 6.0), 6.0), 1.0 - p, 1e-12);
    EXPECT_NEAR(FisherFTail(FisherFQuantile(p, 3.0, 20.5), 3.0, 20.5), 1.0 - p, 1e-12);
  }
}

// One degree of freedom: (4.1308)^2 for 0.1 % and a power of 80 % (Baarda's factor); else by
// repeats.
TEST(Quantiles, NoncentralityIsBaardasAndThatOfRepeats) {
  EXPECT_NEAR(std::sqrt(ChiSquareNoncentrality(0.001, 0.8, 1.0)), 4.132, 1e-3);
  const double shift = std::sqrt(ChiSquareNoncentrality(0.01, 0.8, 6.0));
  auto rng = testing::SeededByTest();
  constexpr int kDraws = 100000;
  int seen = 0;
  for (int i = 0; i < kDraws; ++i) {
    Eigen::VectorXd z = testing::Normal(rng, 6);
    z[2] += shift;
    seen += z.squaredNorm() > ChiSquareQuantile(0.99, 6.0);
  }
  EXPECT_NEAR(static_cast<double>(seen) / kDraws, 0.8, 0.006);
}

TEST(Quantiles, DensityIsTheSlopeOfTheTail) {
  constexpr double kStep = 1e-5;
  for (const double x : {0.2, 1.0, 4.0}) {
    const double slope =
        (FisherFTail(x - kStep, 3.0, 20.0) - FisherFTail(x + kStep, 3.0, 20.0)) / (2.0 * kStep);
    EXPECT_NEAR(FisherFDensity(x, 3.0, 20.0), slope, 1e-9);
  }
}

// With many degrees of freedom F is chi-square; with few, by repeats.
TEST(Quantiles, TailOfTheSumOfTwoF) {
  for (const double x : {1e-9, 0.5, 6.0, 20.0, 60.0})
    EXPECT_NEAR(FisherSumTail(x, 3.0, 1e7, 1e7) / ChiSquareTail(x, 6.0), 1.0, 1e-4) << x;
  EXPECT_NEAR(FisherSumTail(30.0, 3.0, 1e-2 + 9.0, 1e7), FisherSumTail(30.0, 3.0, 1e7, 9.01), 1e-9);
  auto rng = testing::SeededByTest();
  constexpr int kDraws = 200000;
  std::chi_squared_distribution<double> three(3.0), nine(9.0), thirty(30.0);
  int above_10 = 0, above_40 = 0;
  for (int k = 0; k < kDraws; ++k) {
    const double x = three(rng) / (nine(rng) / 9.0) + three(rng) / (thirty(rng) / 30.0);
    above_10 += x > 10.0;
    above_40 += x > 40.0;
  }
  for (const auto& [count, x] : {std::pair(above_10, 10.0), std::pair(above_40, 40.0)}) {
    const double p = FisherSumTail(x, 3.0, 9.0, 30.0);
    EXPECT_NEAR(count, p * kDraws, 4.0 * std::sqrt(p * kDraws)) << x;
  }
}

}  // namespace
}  // namespace hexcal
