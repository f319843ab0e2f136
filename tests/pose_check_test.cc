// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/pose_check.h"

#include <gtest/gtest.h>

#include <cmath>

#include "estimator/calibrate.h"
#include "estimator/outliers.h"
#include "testing/matchers.h"
#include "testing/outliers.h"
#include "testing/scenes.h"

namespace hexcal {
namespace {

using ::hexcal::testing::SeededByTest;

constexpr double kAlpha = 0.01, kPower = 0.8;
constexpr NoiseLevels kNoise = {1e-4, 5e-4};

// An error of that size is what the search for outliers finds four times of five in the worst
// direction, and more often in others.
TEST(PoseCheck, SmallestErrorIsWhatTheSearchFindsWithItsPower) {
  constexpr int kTrials = 300;
  auto rng = SeededByTest();
  const BaseAndTool truth = testing::AnyMounts(rng);
  const auto clean = testing::HexapodObservations(rng, truth, 12);
  const auto observations = testing::KnownNoise(clean, testing::Isotropic(kNoise));
  const auto smallest = CheckPoses(observations, truth, kNoise, kAlpha, kPower);
  ASSERT_EQ(smallest.size(), 12u);
  double redundancy = 0.0;
  for (const PoseCheck& one : smallest) {
    redundancy += 6.0 * one.redundancy;
    EXPECT_GT(one.smallest_position, 4.0 * kNoise.position) << one.label;
    EXPECT_GT(one.smallest_orientation, 4.0 * kNoise.orientation) << one.label;
  }
  EXPECT_NEAR(redundancy, 6.0 * 12.0 - 12.0, 1e-6);  // of all residuals, less the parameters

  int found = 0, any = 0;
  for (int i = 0; i < kTrials; ++i) {
    auto rows = clean;
    testing::AddNoise(rng, testing::Isotropic(kNoise), &rows);
    Vector6d error = Vector6d::Zero();
    error.head<3>() =
        smallest[4].smallest_position * Eigen::Vector3d(testing::Normal(rng, 3)).normalized();
    rows[4].world_from_tool = Plus(rows[4].world_from_tool, error);
    const auto search =
        FindOutliers(testing::KnownNoise(rows, testing::Isotropic(kNoise)), std::nullopt, {kAlpha});
    any += !search.outliers.empty();
    for (const Outlier& o : search.outliers) found += o.index == 4;
  }
  // Not less than the power, but for four standard errors; in other directions than the worst more.
  EXPECT_GE(found, kTrials * kPower - 4.0 * std::sqrt(kTrials * kPower * (1.0 - kPower)));
  EXPECT_LT(found, kTrials);
  EXPECT_GE(any, found);
}

// Held out by the formula is held out by leaving out and fitting again.
TEST(PoseCheck, HeldOutErrorIsThatOfAFitWithoutThePose) {
  auto rng = SeededByTest();
  const BaseAndTool truth = testing::AnyMounts(rng);
  auto rows = testing::HexapodObservations(rng, truth, 12);
  const Matrix6d noise = testing::Isotropic({1e-6, 5e-6});
  testing::AddNoise(rng, noise, &rows);
  const Observations all = testing::KnownNoise(rows, noise);
  const Estimate fit = Calibrate(all, {}, {});
  const auto checks = CheckPoses(all, fit.mounts, {}, kAlpha, kPower);
  double squared = 0.0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    auto others = rows;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    const Estimate without = Calibrate(testing::KnownNoise(others, noise), {}, {});
    const Vector6d error =
        PoseError(without.mounts, rows[i].base_from_platform, rows[i].world_from_tool);
    EXPECT_TRUE(testing::MatrixNear(checks[i].held_out, error, 1e-8));
    squared += checks[i].held_out.head<3>().squaredNorm() /
               (checks[i].expected_position * checks[i].expected_position);
  }
  EXPECT_NEAR(squared / 12.0, 1.0, 0.6);
}

// Of weight 0 it has no part in the others, nor they in it.
TEST(PoseCheck, APoseThatWasRejectedIsComparedWithThePredictionAsItIs) {
  auto rng = SeededByTest();
  auto rows = testing::HexapodObservations(rng, testing::AnyMounts(rng), 14);
  testing::AddNoise(rng, testing::Isotropic(kNoise), &rows);
  testing::Spoil(rng, testing::Spoilt::kBoth, 30.0, kNoise, &rows[3]);
  const Observations all = testing::KnownNoise(rows, testing::Isotropic(kNoise));
  rows.erase(rows.begin() + 3);
  const Observations others = testing::KnownNoise(rows, testing::Isotropic(kNoise));
  const BaseAndTool mounts = Calibrate(others, {}, {}).mounts;
  WeightedAs weighted;
  weighted.weights.assign(14, 1.0);
  weighted.weights[3] = 0.0;
  const auto checks = CheckPoses(all, mounts, {}, kAlpha, kPower, weighted);
  const auto of_others = CheckPoses(others, mounts, {}, kAlpha, kPower);
  ASSERT_EQ(checks.size(), 14u);
  const Observation& o = all.items[3];
  EXPECT_TRUE(testing::MatrixNear(
      checks[3].held_out, PoseError(mounts, o.base_from_platform, o.world_from_tool), 1e-14));
  EXPECT_EQ(checks[3].redundancy, 1.0);
  EXPECT_GT(checks[3].squared, 1000.0);
  for (int i = 0; i < 13; ++i)
    EXPECT_NEAR(checks[i < 3 ? i : i + 1].squared / of_others[i].squared, 1.0, 1e-9);
}

// Under a loss a clean pose is as far from what the others predict as is stated: 6 squared sigmas.
TEST(PoseCheck, UnderALossTheOthersPredictAsFarAsStated) {
  auto rng = SeededByTest();
  CalibrateOptions options;
  options.loss = {LossKind::kTukey, 4.0};
  double squared = 0.0;
  int count = 0;
  for (int k = 0; k < 60; ++k) {
    auto rows = testing::HexapodObservations(rng, testing::AnyMounts(rng), 24);
    testing::AddNoise(rng, testing::Isotropic(kNoise), &rows);
    const Observations all = testing::KnownNoise(rows, testing::Isotropic(kNoise));
    const Estimate estimate = Calibrate(all, {}, options);
    WeightedAs weighted;
    for (const PoseResult& pose : estimate.poses) weighted.weights.push_back(pose.weight);
    weighted.variance = LossCovarianceFactor(all, estimate.mounts, {}, options.loss);
    for (const PoseCheck& check : CheckPoses(all, estimate.mounts, {}, kAlpha, kPower, weighted)) {
      squared += check.squared;
      ++count;
    }
  }
  EXPECT_NEAR(squared / count, 6.0, 0.6);
}

}  // namespace
}  // namespace hexcal
