// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/normal_plot.h"

#include <gtest/gtest.h>

#include <cmath>

#include "testing/random.h"

namespace hexcal {
namespace {

constexpr std::size_t kAll = 1000;

std::vector<double> Draw(std::mt19937_64& rng, int count) {
  const Eigen::VectorXd z = testing::Normal(rng, count);
  return {z.data(), z.data() + z.size()};
}

// One number: the normal distribution itself. Of three, the largest is below Phi(x)^3.
TEST(NormalPlot, OfOneAndOfThreeIsTheClosedForm) {
  const auto one = NormalPlot({0.25}, kAll);
  ASSERT_EQ(one.size(), 1u);
  EXPECT_EQ(one[0].rank, 1u);
  EXPECT_EQ(one[0].value, 0.25);
  EXPECT_NEAR(one[0].expected, 0.0, 1e-15);
  EXPECT_NEAR(one[0].low, -1.959964, 1e-6);
  EXPECT_NEAR(one[0].high, 1.959964, 1e-6);

  const auto three = NormalPlot({3.0, -1.0, 2.0}, kAll);
  ASSERT_EQ(three.size(), 3u);
  const auto below = [](double x) { return 0.5 * std::erfc(-x / std::sqrt(2.0)); };
  EXPECT_EQ(three[2].value, 3.0);
  EXPECT_NEAR(std::pow(below(three[2].expected), 3), 0.5, 1e-12);
  EXPECT_NEAR(std::pow(below(three[2].low), 3), 0.025, 1e-12);
  EXPECT_NEAR(std::pow(below(three[2].high), 3), 0.975, 1e-12);
  EXPECT_NEAR(three[1].expected, 0.0, 1e-15);
  EXPECT_EQ(three[0].value, -1.0);
  EXPECT_NEAR(three[0].low, -three[2].high, 1e-12);
  EXPECT_NEAR(three[0].high, -three[2].low, 1e-12);
}

TEST(NormalPlot, LimitsHold95PercentOfRepeatsAtEveryPlace) {
  constexpr int kDraws = 4000, kCount = 60;
  auto rng = testing::SeededByTest();
  std::vector<int> inside(kCount), below(kCount);
  for (int draw = 0; draw < kDraws; ++draw)
    for (const NormalPlotPoint& p : NormalPlot(Draw(rng, kCount), kAll)) {
      inside[p.rank - 1] += p.value >= p.low && p.value <= p.high;
      below[p.rank - 1] += p.value < p.expected;
    }
  for (int i = 0; i < kCount; ++i) {
    EXPECT_NEAR(inside[i], 0.95 * kDraws, 5.0 * std::sqrt(kDraws * 0.95 * 0.05)) << i;
    EXPECT_NEAR(below[i], 0.5 * kDraws, 5.0 * std::sqrt(kDraws * 0.25)) << i;
  }
}

// What is not drawn does not change the places of what is.
TEST(NormalPlot, OfManyKeepsTheExtremesAndTheirPlaces) {
  auto rng = testing::SeededByTest();
  const std::vector<double> values = Draw(rng, 5001);
  const auto all = NormalPlot(values, 6000), some = NormalPlot(values, 400);
  ASSERT_EQ(all.size(), 5001u);
  EXPECT_LE(some.size(), 401u);
  EXPECT_GE(some.size(), 350u);
  for (std::size_t i = 0; i < some.size(); ++i) {
    EXPECT_EQ(some[i].value, all[some[i].rank - 1].value);
    EXPECT_EQ(some[i].expected, all[some[i].rank - 1].expected);
    if (i < 100) {
      EXPECT_EQ(some[i].rank, i + 1);
    }
    if (i >= some.size() - 100) {
      EXPECT_EQ(some[i].rank, 5001 - (some.size() - 1 - i));
    }
    if (i > 0) {
      EXPECT_LE(some[i].rank - some[i - 1].rank, 25u);
    }
  }
  EXPECT_TRUE(NormalPlot({}, kAll).empty());
}

}  // namespace
}  // namespace hexcal
