// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/autocorrelation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "testing/random.h"

namespace hexcal {
namespace {

Eigen::VectorXd Row(double x, double y) { return Eigen::Vector2d(x, y); }

// sum of squares 4 + 4; products one step apart (-3) + (3), two apart 2 + 2.
TEST(Autocorrelation, OfFourRowsIsWhatTheHandFinds) {
  const auto found = FindAutocorrelation({Row(1, 1), Row(-1, 1), Row(1, 1), Row(-1, 1)}, 2);
  ASSERT_EQ(found.of_lag.size(), 2u);
  EXPECT_DOUBLE_EQ(found.of_lag[0], 0.0);
  EXPECT_DOUBLE_EQ(found.of_lag[1], 0.5);
  EXPECT_DOUBLE_EQ(found.band, 2.0 / std::sqrt(8.0));
  const auto alternating = FindAutocorrelation({Row(1, 2), Row(-1, -2), Row(1, 2)}, 20);
  ASSERT_EQ(alternating.of_lag.size(), 2u);
  EXPECT_DOUBLE_EQ(alternating.of_lag[0], -2.0 / 3.0);
  EXPECT_DOUBLE_EQ(alternating.of_lag[1], 1.0 / 3.0);
}

// A rejected pose leaves a gap; those behind it stay as far from those before it.
TEST(Autocorrelation, WhatIsMissingHasNoPartAndMovesNothing) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto found = FindAutocorrelation({Row(1, 0), Row(nan, nan), Row(1, 0), Row(0, 1)}, 3);
  EXPECT_DOUBLE_EQ(found.of_lag[0], 0.0);
  EXPECT_DOUBLE_EQ(found.of_lag[1], 1.0 / 3.0);
  EXPECT_DOUBLE_EQ(found.band, 2.0 / std::sqrt(6.0));
  EXPECT_TRUE(FindAutocorrelation({Row(0, 0), Row(nan, 0)}, 3).of_lag.empty());
  EXPECT_TRUE(FindAutocorrelation({}, 3).of_lag.empty());
}

TEST(Autocorrelation, OfNoiseStaysInTheBandAndOfAMemoryIsItsPowers) {
  auto rng = testing::SeededByTest();
  constexpr int kDraws = 2000, kRows = 60;
  int inside = 0;
  for (int draw = 0; draw < kDraws; ++draw) {
    std::vector<Eigen::VectorXd> rows;
    for (int i = 0; i < kRows; ++i) rows.push_back(testing::Normal(rng, 3));
    const auto found = FindAutocorrelation(rows, 1);
    inside += std::abs(found.of_lag[0]) < found.band;
  }
  EXPECT_NEAR(inside, 0.954 * kDraws, 5.0 * std::sqrt(kDraws * 0.954 * 0.046));

  std::vector<Eigen::VectorXd> rows = {testing::Normal(rng, 3)};
  for (int i = 1; i < 20000; ++i)
    rows.emplace_back(0.8 * rows.back() + 0.6 * testing::Normal(rng, 3));
  const auto found = FindAutocorrelation(rows, 3);
  for (int lag = 1; lag <= 3; ++lag)
    EXPECT_NEAR(found.of_lag[lag - 1], std::pow(0.8, lag), 0.03) << lag;
}

}  // namespace
}  // namespace hexcal
