// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/standard_residual.h"

#include <gtest/gtest.h>

#include <cmath>

#include "estimator/calibrate.h"
#include "testing/matchers.h"
#include "testing/scenes.h"

namespace hexcal {
namespace {

using testing::SeededByTest;

TEST(StandardResidual, IsTheErrorByItsNoiseLessWhatTheFitTook) {
  Vector6d error;
  error << 1e-4, 2e-4, -3e-4, 1e-3, 0.0, 2e-3;
  const Matrix6d noise = testing::Isotropic(1e-4, 1e-3);
  const Vector6d white = StandardResidual(error, noise, Matrix6d::Zero());
  Vector6d expected;
  expected << 1.0, 2.0, -3.0, 1.0, 0.0, 2.0;
  EXPECT_TRUE(testing::MatrixNear(white, expected, 1e-12));
  // Three quarters of the variance are taken: what is left has half the size.
  const Vector6d standard = StandardResidual(error, noise, 0.75 * noise);
  EXPECT_TRUE(testing::MatrixNear(standard, Vector6d(2.0 * expected), 1e-12));
  EXPECT_TRUE(StandardResidual(error, noise, 0.995 * noise).array().isNaN().all());
}

// Unequal, correlated noise and few poses, of which the fit takes a quarter: still each has unit
// variance. Whitened residuals alone would have 0.75.
TEST(StandardResidual, HasUnitVarianceOverRepeatsHoweverFewThePoses) {
  constexpr int kDraws = 400, kPoses = 8;
  auto rng = SeededByTest();
  const BaseAndTool truth = testing::AnyMounts(rng);
  const auto clean = testing::HexapodObservations(rng, truth, kPoses);
  const Matrix6d noise = testing::TrackerLikeCovariance();
  std::vector<Vector6d> squares(kPoses, Vector6d::Zero());
  for (int draw = 0; draw < kDraws; ++draw) {
    auto rows = clean;
    testing::AddNoise(rng, noise, &rows);
    const Observations observations = testing::KnownNoise(rows, noise);
    const auto standard = StandardResiduals(observations, Calibrate(observations, {}, {}));
    ASSERT_EQ(standard.size(), static_cast<std::size_t>(kPoses));
    for (int i = 0; i < kPoses; ++i) squares[i] += standard[i].cwiseAbs2() / kDraws;
  }
  double mean = 0.0;
  for (const Vector6d& pose : squares)
    for (const double square : pose) {
      EXPECT_NEAR(square, 1.0, 5.0 * std::sqrt(2.0 / kDraws));
      mean += square / (6.0 * kPoses);
    }
  EXPECT_NEAR(mean, 1.0, 0.04);
}

// By levels that are given with robot noise beside them, or estimated.
TEST(StandardResidual, KnowsWhatTheEstimateWasWeightedBy) {
  constexpr int kPoses = 400;
  auto rng = SeededByTest();
  const NoiseLevels levels{1e-4, 1e-3};
  const BaseAndTool truth = testing::AnyMounts(rng);
  auto rows = testing::HexapodObservations(rng, truth, kPoses);
  testing::AddNoise(rng, testing::Isotropic(levels), &rows);
  const Matrix6d robot = testing::Isotropic(2e-4, 1e-3);
  const Matrix6d carry = InverseAdjoint(truth.platform_from_tool);
  for (const bool has_robot : {false, true})
    for (const bool is_given : {true, false}) {
      Observations observations = testing::UnknownNoise(rows);
      if (has_robot) {
        testing::AddNoise(rng, carry * robot * carry.transpose(), &observations.items);
        for (Observation& o : observations.items) o.robot_covariance = robot;
        observations.has_robot_noise = true;
      }
      CalibrateOptions options;
      if (is_given) options.noise = levels;
      const auto standard = StandardResiduals(observations, Calibrate(observations, {}, options));
      double squares = 0.0;
      for (const Vector6d& pose : standard) squares += pose.squaredNorm() / (6.0 * kPoses);
      EXPECT_NEAR(squares, 1.0, 0.12) << has_robot << is_given;
    }
}

TEST(StandardResidual, OfRejectedPosesAndOfExactDataIsNone) {
  auto rng = SeededByTest();
  const auto clean = testing::HexapodObservations(rng, testing::AnyMounts(rng), 12);
  auto rows = clean;
  testing::AddNoise(rng, testing::Isotropic(1e-4, 1e-3), &rows);
  const Observations observations = testing::UnknownNoise(rows);
  Estimate estimate = Calibrate(observations, {}, {});
  estimate.poses[3].weight = 0.0;
  const auto standard = StandardResiduals(observations, estimate);
  EXPECT_TRUE(standard[3].array().isNaN().all());
  EXPECT_TRUE(standard[4].allFinite());
  estimate.noise.position = 0.0;
  EXPECT_TRUE(StandardResiduals(observations, estimate).empty());
}

}  // namespace
}  // namespace hexcal
