// SPDX-License-Identifier: BSD-3-Clause
// Calibration under a robust loss.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "estimator/calibrate.h"
#include "testing/matchers.h"
#include "testing/outliers.h"
#include "testing/scenes.h"

namespace hexcal {
namespace {

using testing::AnyMounts;
using testing::Difference;
using ::testing::HasSubstr;
using testing::SeededByTest;
using testing::UnknownNoise;

constexpr NoiseLevels kNoise = {1e-4, 2e-4};
constexpr LossKind kLosses[] = {LossKind::kHuber, LossKind::kCauchy, LossKind::kTukey};

template <typename Rng>
std::vector<Observation> NoisyRows(Rng& rng, const BaseAndTool& truth, int poses) {
  std::vector<Observation> rows = testing::HexapodObservations(rng, truth, poses);
  Vector6d sigma;
  sigma << Eigen::Vector3d::Constant(kNoise.position),
      Eigen::Vector3d::Constant(kNoise.orientation);
  testing::AddNoise(rng, Matrix6d(sigma.cwiseAbs2().asDiagonal()), &rows);
  return rows;
}

CalibrateOptions With(LossKind kind) {
  CalibrateOptions options;
  options.loss = DefaultLoss(kind);
  return options;
}

// No pose is within a tenth of a sigma: there is nothing to fit, and no number of it may be none.
TEST(Loss, OneThatLeavesNoPoseAWeightIsNoSolution) {
  auto rng = SeededByTest();
  const std::vector<Observation> rows = NoisyRows(rng, AnyMounts(rng), 12);
  CalibrateOptions options;
  for (const double scale : {0.1, 0.3})
    for (const bool is_known : {false, true}) {
      options.loss = {LossKind::kTukey, scale};
      if (is_known) options.noise = kNoise;
      const Estimate estimate = Calibrate(UnknownNoise(rows), {}, options);
      EXPECT_FALSE(estimate.converged);
      EXPECT_THAT(estimate.message, HasSubstr("of 12 poses a weight, too few for base and tool"));
      EXPECT_GT(estimate.degrees_of_freedom, 0);
      EXPECT_TRUE(std::isfinite(estimate.noise_scale));
      EXPECT_TRUE(std::isfinite(estimate.rmspe));
      EXPECT_TRUE(estimate.covariance.allFinite());
    }
}

TEST(Loss, OutliersHardlyCount) {
  auto rng = SeededByTest();
  for (const LossKind kind : kLosses) {
    double squared = 0.0, squared_of_clean = 0.0;
    for (int k = 0; k < 8; ++k) {
      const BaseAndTool truth = AnyMounts(rng);
      std::vector<Observation> rows = NoisyRows(rng, truth, 40);
      const Estimate clean = Calibrate(UnknownNoise(rows), {}, {});
      const auto bad = testing::DrawIndices(rng, 4, 40);
      for (const std::size_t i : bad)
        testing::Spoil(rng, testing::Spoilt::kBoth, 60.0, kNoise, &rows[i]);
      const Estimate robust = Calibrate(UnknownNoise(rows), {}, With(kind));
      ASSERT_TRUE(robust.IsTrustworthy());
      EXPECT_TRUE(robust.noise.estimated);
      EXPECT_NEAR(robust.noise.position, kNoise.position, 0.25 * kNoise.position);
      for (std::size_t i = 0; i < rows.size(); ++i)
        EXPECT_EQ(robust.poses[i].weight < 0.1, std::binary_search(bad.begin(), bad.end(), i));
      squared += Difference(robust.mounts, truth).squaredNorm();
      squared_of_clean += Difference(clean.mounts, truth).squaredNorm();
    }
    EXPECT_LT(squared, (kind == LossKind::kHuber ? 4.0 : 2.0) * squared_of_clean);
  }
}

TEST(Loss, TheStreamedAndThePerPoseProblemAgree) {
  auto rng = SeededByTest();
  for (const LossKind kind : kLosses) {
    std::vector<Observation> rows = NoisyRows(rng, AnyMounts(rng), 30);
    testing::SpoilGrossly(rng, testing::DrawIndices(rng, 5, 30), kNoise, &rows);
    CalibrateOptions options = With(kind);
    const Estimate streamed = Calibrate(UnknownNoise(rows), {}, options);
    options.evaluation = Evaluation::kPerPose;
    const Estimate per_pose = Calibrate(UnknownNoise(rows), {}, options);
    ASSERT_TRUE(streamed.converged && per_pose.converged);
    const Vector12d sigmas = Difference(streamed.mounts, per_pose.mounts)
                                 .cwiseQuotient(streamed.covariance.diagonal().cwiseSqrt());
    EXPECT_LT(sigmas.cwiseAbs().maxCoeff(), 1e-6);
    EXPECT_TRUE(testing::MatrixNear(streamed.covariance / streamed.covariance.norm(),
                                    per_pose.covariance / streamed.covariance.norm(),
                                    1e-6));
  }
}

// A scale beyond all residuals is no loss.
TEST(Loss, FarFromEveryResidualItIsLeastSquares) {
  auto rng = SeededByTest();
  std::vector<Observation> rows = NoisyRows(rng, AnyMounts(rng), 30);
  CalibrateOptions options;
  options.noise = kNoise;
  const Estimate plain = Calibrate(UnknownNoise(rows), {}, options);
  options.loss = {LossKind::kHuber, 1000.0};
  const Estimate robust = Calibrate(UnknownNoise(rows), {}, options);
  EXPECT_LT(Difference(plain.mounts, robust.mounts).cwiseAbs().maxCoeff(), 1e-10);
  EXPECT_NEAR(robust.covariance.norm() / plain.covariance.norm(),
              plain.noise_scale * plain.noise_scale,
              1e-6);
}

TEST(Loss, TheSandwichIsTheCovarianceWhereAskedFor) {
  auto rng = SeededByTest();
  const Observations observations = UnknownNoise(NoisyRows(rng, AnyMounts(rng), 60));
  CalibrateOptions options;
  options.covariance = CovarianceKind::kSandwich;
  const Estimate estimate = Calibrate(observations, {}, options);
  const NoiseLevels levels{estimate.noise.position, estimate.noise.orientation};
  const Matrix12d sandwich = SandwichCovariance(observations, estimate.mounts, levels, {});
  EXPECT_TRUE(
      testing::MatrixNear(estimate.covariance / sandwich.norm(), sandwich / sandwich.norm(), 1e-9));
  EXPECT_EQ(estimate.intervals.degrees_of_freedom[0], 59.0);
}

}  // namespace
}  // namespace hexcal
