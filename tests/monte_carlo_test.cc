// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/monte_carlo.h"

#include <gmock/gmock.h>

#include <algorithm>

#include "estimator/calibrate.h"
#include "testing/bits.h"
#include "testing/scenes.h"

namespace hexcal {
namespace {

using testing::AnyMounts;
using ::testing::HasSubstr;
using testing::HexapodObservations;
using testing::KnownNoise;
using testing::SeededByTest;
using testing::TrackerLikeCovariance;
using testing::UnknownNoise;

MonteCarloOptions Draws(int draws) {
  MonteCarloOptions options;
  options.draws = draws;
  return options;
}

TEST(MonteCarlo, ToleranceIsHalfAUnitOfTheLastDigit) {
  EXPECT_DOUBLE_EQ(NumericalTolerance(0.045, 2), 0.0005);
  EXPECT_DOUBLE_EQ(NumericalTolerance(0.099, 2), 0.0005);
  EXPECT_DOUBLE_EQ(NumericalTolerance(0.11, 2), 0.005);
  EXPECT_DOUBLE_EQ(NumericalTolerance(35.0, 2), 0.5);  // JCGM 101, 7.9.2: 35 g
  EXPECT_DOUBLE_EQ(NumericalTolerance(2e-6, 1), 0.5e-6);
  EXPECT_EQ(NumericalTolerance(0.0, 2), 0.0);
}

TEST(MonteCarlo, AgreesWithTheCovarianceAtATrackersNoise) {
  auto rng = SeededByTest();
  auto rows = HexapodObservations(rng, AnyMounts(rng), 30);
  testing::AddNoise(rng, 1e-2 * TrackerLikeCovariance(), &rows);
  const Observations observations = KnownNoise(rows, 1e-2 * TrackerLikeCovariance());
  const Estimate estimate = Calibrate(observations, {}, {});
  const PropagationCheck check = CheckPropagation(observations, {}, estimate, Draws(1000));
  ASSERT_TRUE(check.done) << check.why_not;
  EXPECT_TRUE(check.validated && check.stable);
  EXPECT_EQ(check.not_converged, 0);
  EXPECT_GE(check.draws, 1000);
  for (int i = 0; i < 12; ++i) {
    const double sigma = std::sqrt(estimate.covariance_unscaled(i, i));
    EXPECT_NEAR(check.intervals[i].sigma, sigma, 1e-3 * sigma);  // Jacobian at the residuals, at 0
    EXPECT_NEAR(check.intervals[i].low, -1.96 * sigma, 0.01 * sigma);
    EXPECT_NEAR(check.intervals[i].high, 1.96 * sigma, 0.01 * sigma);
  }
}

// Noise of nearly a radian: the limits are those of plain repetition with another solver, and no
// longer those of the covariance.
TEST(MonteCarlo, FindsTheLimitsOfRepetitionWhereTheCovarianceDoesNot) {
  auto rng = SeededByTest();
  Vector6d sigma;
  sigma << Eigen::Vector3d::Constant(0.02), Eigen::Vector3d::Constant(0.8);
  const Matrix6d covariance = sigma.cwiseAbs2().asDiagonal();
  const BaseAndTool truth{testing::SmallPose(rng, 1.0, 1.0), testing::SmallPose(rng, 0.1, 1.0)};
  auto rows = HexapodObservations(rng, truth, 12);
  for (Observation& o : rows) {
    o.base_from_platform = testing::RandomPose(rng, 0.2);
    o.world_from_tool = truth.world_from_base * o.base_from_platform * truth.platform_from_tool;
  }
  const Observations observations = KnownNoise(rows, covariance);
  const Estimate estimate = Calibrate(observations, {}, {});
  const PropagationCheck check = CheckPropagation(observations, {}, estimate, Draws(1000));
  ASSERT_TRUE(check.done) << check.why_not;
  EXPECT_FALSE(check.validated);

  constexpr int kPlain = 1000;
  std::vector<std::vector<double>> plain(12);
  Vector6d inverse = sigma.cwiseInverse();
  const std::vector<Matrix6d> whiteners(rows.size(), inverse.asDiagonal());
  for (int k = 0; k < kPlain; ++k) {
    auto again = rows;
    for (Observation& o : again)
      o.world_from_tool = estimate.mounts.world_from_base * o.base_from_platform *
                          estimate.mounts.platform_from_tool;
    testing::AddNoise(rng, covariance, &again);
    const auto d = testing::Difference(SolveNonlinear(again, whiteners, estimate.mounts, {}).mounts,
                                       estimate.mounts);
    for (int i = 0; i < 12; ++i) plain[i].push_back(d[i]);
  }
  double width = 0.0, plain_width = 0.0;  // of the three turns of the tool, in sigmas
  for (int i = 0; i < 12; ++i) {
    std::sort(plain[i].begin(), plain[i].end());
    const IntervalCheck& c = check.intervals[i];
    const double low = plain[i][kPlain / 40], high = plain[i][kPlain - kPlain / 40];
    // An end has a standard error of 2.7 sigma / sqrt(draws).
    EXPECT_NEAR(c.low, low, 4.0 * 2.7 * c.sigma / std::sqrt(kPlain));
    EXPECT_NEAR(c.high, high, 4.0 * 2.7 * c.sigma / std::sqrt(kPlain));
    if (i < 9) continue;
    width += (c.high - c.low) / c.sigma / 3.0;
    plain_width += (high - low) / c.sigma / 3.0;
  }
  EXPECT_NEAR(width, plain_width, 0.28);  // four standard errors
  EXPECT_GT(width, 2.0 * 1.96 + 0.35);
}

TEST(MonteCarlo, DoesNotDependOnThreads) {
  auto rng = SeededByTest();
  auto rows = HexapodObservations(rng, AnyMounts(rng), 10);
  testing::AddNoise(rng, TrackerLikeCovariance(), &rows);
  const Observations observations = KnownNoise(rows, TrackerLikeCovariance());
  const Estimate estimate = Calibrate(observations, {}, {});
  MonteCarloOptions options = Draws(1000);
  const PropagationCheck one = CheckPropagation(observations, {}, estimate, options);
  options.threads = 3;
  const PropagationCheck three = CheckPropagation(observations, {}, estimate, options);
  options.seed = 2;
  const PropagationCheck other = CheckPropagation(observations, {}, estimate, options);
  EXPECT_EQ(one.draws, three.draws);
  for (int i = 0; i < 12; ++i) {
    EXPECT_TRUE(testing::SameBits(one.intervals[i].low, three.intervals[i].low));
    EXPECT_TRUE(testing::SameBits(one.intervals[i].accuracy, three.intervals[i].accuracy));
    EXPECT_NE(one.intervals[i].low, other.intervals[i].low);
  }
}

TEST(MonteCarlo, SaysWhyItIsNotDone) {
  auto rng = SeededByTest();
  const BaseAndTool truth = AnyMounts(rng);
  auto rows = HexapodObservations(rng, truth, 10);
  const Observations exact = UnknownNoise(rows);
  Estimate estimate = Calibrate(exact, {}, {});
  const NoiseLevels levels{estimate.noise.position, estimate.noise.orientation};
  EXPECT_THAT(CheckPropagation(exact, levels, estimate, Draws(1000)).why_not,
              HasSubstr("no noise"));
  estimate.converged = false;
  EXPECT_THAT(CheckPropagation(exact, levels, estimate, Draws(1000)).why_not,
              HasSubstr("did not converge"));
  for (Observation& o : rows) {
    o.base_from_platform.rotation = Exp(Eigen::Vector3d(0, 0, testing::Uniform(rng, -1, 1)));
    o.world_from_tool = truth.world_from_base * o.base_from_platform * truth.platform_from_tool;
  }
  testing::AddNoise(rng, TrackerLikeCovariance(), &rows);
  const Observations one_axis = KnownNoise(rows, TrackerLikeCovariance());
  const PropagationCheck check =
      CheckPropagation(one_axis, {}, Calibrate(one_axis, {}, {}), Draws(1000));
  EXPECT_FALSE(check.done || check.validated);
  EXPECT_THAT(check.why_not, HasSubstr("do not determine"));
}

}  // namespace
}  // namespace hexcal
