// SPDX-License-Identifier: BSD-3-Clause
// The noise of a gap: levels, tails and correlation found where they are, and not where they are
// not.
#include "discovery/gap_noise.h"

#include <gtest/gtest.h>

#include <cmath>

#include "testing/random.h"

namespace hexcal {
namespace {

using ::hexcal::testing::Normal;
using ::hexcal::testing::SeededByTest;

constexpr int kPoses = 72, kNuisances = 12;

// Two components: positions and orientations, of the given sigmas.
template <typename Rng>
LinearProblem MakeProblem(Rng& rng, double position, double orientation) {
  LinearProblem problem;
  problem.poses = kPoses;
  problem.nuisance.resize(6 * kPoses, kNuisances);
  for (int k = 0; k < kNuisances; ++k) problem.nuisance.col(k) = Normal(rng, 6 * kPoses);
  problem.error = Normal(rng, 6 * kPoses);
  for (int k = 0; k < kPoses; ++k) {
    problem.error.segment<3>(6 * k) *= position;
    problem.error.segment<3>(6 * k + 3) *= orientation;
  }
  Matrix6d first = Matrix6d::Zero(), second = Matrix6d::Zero();
  first.topLeftCorner<3, 3>().setIdentity(), second.bottomRightCorner<3, 3>().setIdentity();
  problem.components = {std::vector<Matrix6d>(kPoses, first),
                        std::vector<Matrix6d>(kPoses, second)};
  problem.shape_nuisance.resize(0, kNuisances);
  return problem;
}

// A straight line of each axis over the poses.
Eigen::MatrixXd Trend() {
  Eigen::MatrixXd trend = Eigen::MatrixXd::Zero(6 * kPoses, 6);
  for (int k = 0; k < kPoses; ++k)
    trend.middleRows<6>(6 * k) = (k - 0.5 * (kPoses - 1)) * Matrix6d::Identity();
  return trend;
}

TEST(GapNoise, FindsBothLevels) {
  auto rng = SeededByTest();
  double position = 0.0, orientation = 0.0;
  constexpr int kSets = 20;
  for (int i = 0; i < kSets; ++i) {
    const LinearProblem problem = MakeProblem(rng, 3e-5, 2e-4);
    const GapNoise noise = EstimateGapNoise(problem, Trend());
    position += noise.factor[0] / kSets, orientation += noise.factor[1] / kSets;
  }
  // 20 times 216 numbers each: 2.2 % (1 sigma) of a variance.
  EXPECT_NEAR(position / (3e-5 * 3e-5), 1.0, 0.08);
  EXPECT_NEAR(orientation / (2e-4 * 2e-4), 1.0, 0.08);
}

TEST(GapNoise, GaussianNoiseHasNoTailsAndNoCorrelation) {
  auto rng = SeededByTest();
  int tails = 0, correlated = 0;
  for (int i = 0; i < 100; ++i) {
    const GapNoise noise = EstimateGapNoise(MakeProblem(rng, 1.0, 1.0), Trend());
    tails += noise.tail_freedom != 0.0, correlated += noise.correlation != 0.0;
  }
  EXPECT_LE(tails, 3);
  EXPECT_LE(correlated, 2);
}

TEST(GapNoise, FindsHeavyTailsAndWeighsDownBadPoses) {
  auto rng = SeededByTest();
  LinearProblem problem = MakeProblem(rng, 1.0, 1.0);
  for (const int bad : {5, 30, 31, 60}) problem.error.segment<6>(6 * bad) *= 6.0;
  const GapNoise noise = EstimateGapNoise(problem, Trend());
  EXPECT_GT(noise.tail_freedom, 0.0);
  for (const int bad : {5, 30, 31, 60}) EXPECT_LT(noise.weight[bad], 0.3) << bad;
  EXPECT_NEAR(noise.factor[0], 1.0, 0.35);
}

TEST(GapNoise, FindsACorrelationButTakesNoDriftForOne) {
  auto rng = SeededByTest();
  int found = 0, mistaken = 0;
  for (int i = 0; i < 20; ++i) {
    LinearProblem problem = MakeProblem(rng, 1.0, 1.0);
    LinearProblem drifting = problem;
    for (int k = 1; k < kPoses; ++k)
      problem.error.segment<6>(6 * k) = 0.8 * problem.error.segment<6>(6 * (k - 1)) +
                                        0.6 * problem.error.segment<6>(6 * k).eval();
    drifting.error += Trend() * Vector6d::Constant(0.06);
    found += EstimateGapNoise(problem, Trend()).correlation > 0.5;
    mistaken += EstimateGapNoise(drifting, Trend()).correlation > 0.0;
  }
  EXPECT_GE(found, 19);
  EXPECT_LE(mistaken, 1);
}

TEST(GapNoise, WhitenedErrorsAreWhite) {
  auto rng = SeededByTest();
  const LinearProblem problem = MakeProblem(rng, 2.0, 0.5);
  GapNoise noise = EstimateGapNoise(problem, Trend());
  noise.factor = {4.0, 0.25};
  const Eigen::VectorXd white = WhitenPoseRows(problem, noise, problem.error);
  EXPECT_NEAR(white.squaredNorm() / (6.0 * kPoses), 1.0, 0.2);
  // Half the weight is half the square.
  noise.weight[7] = 0.5;
  const Eigen::VectorXd lighter = WhitenPoseRows(problem, noise, problem.error);
  EXPECT_NEAR(lighter.segment<6>(42).squaredNorm(), 0.5 * white.segment<6>(42).squaredNorm(), 1e-9);
}

}  // namespace
}  // namespace hexcal
