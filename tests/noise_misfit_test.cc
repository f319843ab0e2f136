// SPDX-License-Identifier: BSD-3-Clause
// What a stated noise is judged by where the fit does not weigh by it alone.
#include <gtest/gtest.h>

#include "estimator/calibrate.h"
#include "estimator/quantiles.h"
#include "estimator/rms.h"
#include "report/global_test.h"
#include "testing/outliers.h"
#include "testing/scenes.h"

namespace hexcal {
namespace {

using testing::SeededByTest;

const Matrix6d kNoise = testing::TrackerLikeCovariance();

// Of every way to weigh: three losses, also where they count little of the noise, and equal
// weights.
std::vector<CalibrateOptions> Ways() {
  std::vector<CalibrateOptions> ways;
  for (const LossKind kind : {LossKind::kHuber, LossKind::kCauchy, LossKind::kTukey}) {
    ways.emplace_back().loss = DefaultLoss(kind);
    ways.emplace_back().loss = {kind, 0.8 * DefaultLoss(kind).scale};
  }
  ways.emplace_back().solver = Solver::kLinearized;
  ways.back().start = Start::kClosedForm;
  ways.back().linearized.error = LinearizedOptions::Error::kPaper;
  ways.back().linearized.max_iterations = 60;
  ways.back().linearized.tolerance = 1e-10;
  return ways;
}

// The base near the world, as the paper's iteration needs it.
template <typename Rng>
std::vector<Observation> NoisyRows(Rng& rng, int poses, double times) {
  const BaseAndTool truth = {testing::SmallPose(rng, 0.1, 0.1), testing::SmallPose(rng, 0.1, 0.2)};
  std::vector<Observation> rows = testing::HexapodObservations(rng, truth, poses);
  testing::AddNoise(rng, times * times * kNoise, &rows);
  return rows;
}

TEST(NoiseMisfit, IsWhatLeastSquaresLeavesOfThePoses) {
  auto rng = SeededByTest();
  for (const bool has_outliers : {false, true}) {
    std::vector<Observation> rows = NoisyRows(rng, 40, 1.0);
    if (has_outliers)
      for (const std::size_t i : {3, 17})
        testing::Spoil(rng,
                       testing::Spoilt::kBoth,
                       20.0,
                       {std::sqrt(kNoise(0, 0)), std::sqrt(kNoise(3, 3))},
                       &rows[i]);
    const Observations observations = testing::KnownNoise(rows, kNoise);
    const Estimate plain = Calibrate(observations, {}, {});
    EXPECT_FALSE(plain.least_squares);
    EXPECT_EQ(plain.OfNoise().chi_square, plain.chi_square);
    for (const CalibrateOptions& way : Ways()) {
      const Estimate estimate = Calibrate(observations, {}, way);
      ASSERT_TRUE(estimate.IsTrustworthy()) << estimate.message;
      ASSERT_TRUE(estimate.least_squares);
      // One step: what is left of it is of second order in how far outliers have moved the fit.
      EXPECT_NEAR(
          estimate.least_squares->chi_square / plain.chi_square, 1.0, has_outliers ? 1e-3 : 1e-4);
      EXPECT_EQ(estimate.OfNoise().degrees_of_freedom, 40 * 6 - 12);
      if (way.solver == Solver::kNonlinear) {
        EXPECT_LT(estimate.chi_square, 0.97 * plain.chi_square);  // as the loss weighs
      }
    }
    EXPECT_EQ(GlobalTestOf(plain).is_too_large, has_outliers);
  }
}

// A pose to which the loss gives no weight is in no RMS, but in the chi-square that is tested.
TEST(NoiseMisfit, APoseWithoutWeightIsInNoRms) {
  auto rng = SeededByTest();
  std::vector<Observation> rows = NoisyRows(rng, 40, 1.0);
  rows[7].world_from_tool.translation.x() += 1.0;
  const Observations observations = testing::KnownNoise(rows, kNoise);
  CalibrateOptions options;
  options.loss = DefaultLoss(LossKind::kTukey);
  const Estimate estimate = Calibrate(observations, {}, options);
  ASSERT_EQ(estimate.poses[7].weight, 0.0);
  RmsError used;
  for (const PoseResult& pose : estimate.poses)
    if (pose.weight > 0.0) used.Add(pose.residual);
  EXPECT_DOUBLE_EQ(estimate.rmspe, used.Position());
  EXPECT_DOUBLE_EQ(estimate.rmsoe, used.Orientation());
  EXPECT_LT(estimate.rmspe, 0.1);
  EXPECT_EQ(estimate.degrees_of_freedom, 39 * 6 - 12);
  EXPECT_EQ(estimate.OfNoise().degrees_of_freedom, 40 * 6 - 12);
  ResultHeader header = {"demo", "nonlinear", "pose", ""};
  header.loss = options.loss;
  const std::string text = GlobalTestText(GlobalTestOf(estimate), header, estimate);
  EXPECT_NE(text.find("of all 40 poses, none weighted down"), std::string::npos) << text;
}

// Right 95 times in 100 on clean data; a noise understated by 15 % is found, one that is
// overstated by as much, too.
TEST(NoiseMisfit, TheTestHasItsSizeAndFindsAWrongNoise) {
  auto rng = SeededByTest();
  constexpr int kDraws = 100;
  const std::vector<CalibrateOptions> ways = Ways();
  int held = 0, of = 0, found = 0, found_small = 0, of_wrong = 0;
  for (int k = 0; k < kDraws; ++k) {
    const auto test = [&](int poses, double times, std::size_t way) {
      return GlobalTestOf(
          Calibrate(testing::KnownNoise(NoisyRows(rng, poses, times), kNoise), {}, ways[way]));
    };
    for (std::size_t w = 0; w < ways.size(); ++w) {
      const GlobalTest clean = test(24, 1.0, w);
      EXPECT_TRUE(clean.is_stated);
      EXPECT_FALSE(clean.is_of_fit);
      held += !clean.is_too_large && !clean.is_too_small;
      ++of;
    }
    const std::size_t w = static_cast<std::size_t>(k) % ways.size();
    found += test(60, 1.0 / 0.85, w).is_too_large;
    found_small += test(60, 0.85, w).is_too_small;
    ++of_wrong;
  }
  EXPECT_NEAR(static_cast<double>(held) / of, 0.95, 4.0 * std::sqrt(0.95 * 0.05 / of));
  EXPECT_GT(found, 0.94 * of_wrong);
  EXPECT_GT(found_small, 0.94 * of_wrong);
}

TEST(NoiseMisfit, SaysWhichNumberIsTested) {
  auto rng = SeededByTest();
  const Observations observations = testing::KnownNoise(NoisyRows(rng, 24, 1.0), kNoise);
  CalibrateOptions options;
  options.loss = DefaultLoss(LossKind::kHuber);
  const Estimate estimate = Calibrate(observations, {}, options);
  const GlobalTest test = GlobalTestOf(estimate);
  ResultHeader header = {"demo", "nonlinear", "pose", ""};
  header.loss = options.loss;
  const std::string text = GlobalTestText(test, header, estimate);
  EXPECT_NE(text.find("weighted by the loss"), std::string::npos) << text;
  EXPECT_NE(text.find("not tested"), std::string::npos) << text;
  EXPECT_NE(GlobalTestLines(test, estimate).find("none weighted down"), std::string::npos);
}

}  // namespace
}  // namespace hexcal
