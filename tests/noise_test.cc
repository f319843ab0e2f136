// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/noise.h"

#include <Eigen/Cholesky>

#include "estimator/calibrate.h"
#include "testing/matchers.h"
#include "testing/scenes.h"

namespace hexcal {
namespace {

using testing::AnyMounts;
using testing::HexapodObservations;
using testing::Isotropic;
using testing::SeededByTest;

// Twice the negative restricted log-likelihood of the linearised fit, straight from its definition
// with dense matrices.
double Deviance(const Observations& observations,
                const BaseAndTool& mounts,
                const NoiseLevels& levels) {
  const auto n = static_cast<Eigen::Index>(observations.items.size());
  Eigen::MatrixXd c = Eigen::MatrixXd::Zero(6 * n, 6 * n), j(6 * n, 12);
  Eigen::VectorXd e(6 * n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Observation& o = observations.items[i];
    c.block<6, 6>(6 * i, 6 * i) =
        ErrorCovariance(o, observations, mounts.platform_from_tool, levels);
    e.segment<6>(6 * i) = PoseError(mounts, o.base_from_platform, o.world_from_tool);
    j.middleRows<6>(6 * i) =
        PoseErrorJacobian(e.segment<6>(6 * i), o.base_from_platform * mounts.platform_from_tool);
  }
  const Eigen::MatrixXd w = c.inverse();
  const Eigen::MatrixXd normal = j.transpose() * w * j;
  const Eigen::VectorXd r = e - j * normal.ldlt().solve(j.transpose() * w * e);
  const auto log_determinant = [](const Eigen::MatrixXd& m) {
    return 2.0 * Eigen::MatrixXd(m.llt().matrixL()).diagonal().array().log().sum();
  };
  return log_determinant(c) + log_determinant(normal) + r.dot(w * r);
}

// The estimate is where the deviance is least: any small change of either level makes it larger.
// With and without robot noise.
TEST(Noise, MaximisesTheRestrictedLikelihood) {
  auto rng = SeededByTest();
  for (const bool with_robot : {false, true}) {
    const BaseAndTool truth = AnyMounts(rng);
    auto rows = HexapodObservations(rng, truth, 12);
    testing::AddNoise(rng, Isotropic(3e-4, 2e-3), &rows);
    Observations observations = testing::UnknownNoise(rows);
    observations.has_robot_noise = with_robot;
    if (with_robot)
      for (Observation& o : observations.items) o.robot_covariance = Isotropic(1e-4, 1e-3);
    const NoiseLevels best = EstimateNoise(observations, truth, {1e-3, 1e-3});
    const double least = Deviance(observations, truth, best);
    for (const double factor : {0.98, 1.02}) {
      EXPECT_GT(Deviance(observations, truth, {best.position * factor, best.orientation}), least);
      EXPECT_GT(Deviance(observations, truth, {best.position, best.orientation * factor}), least);
    }
  }
}

// Over many draws with few poses the variances come out right on the mean: the 12 parameters are
// paid for.
TEST(Noise, VariancesAreUnbiasedWithFewPoses) {
  auto rng = SeededByTest();
  const BaseAndTool truth = AnyMounts(rng);
  const auto exact = HexapodObservations(rng, truth, 6);
  const int draws = 1500;
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (int i = 0; i < draws; ++i) {
    auto rows = exact;
    testing::AddNoise(rng, Isotropic(3e-4, 1e-3), &rows);
    const Observations observations = testing::UnknownNoise(rows);
    const Estimate weighted = Calibrate(observations, {}, {});
    mean += Eigen::Vector2d(std::pow(weighted.noise.position / 3e-4, 2),
                            std::pow(weighted.noise.orientation / 1e-3, 2)) /
            draws;
  }
  // One draw's variance has a relative spread of about 0.5: 1500 of them make 0.013.
  EXPECT_TRUE(testing::MatrixNear(mean, Eigen::Vector2d::Ones(), 0.06));
}

TEST(Noise, IsFoundWithManyPoses) {
  auto rng = SeededByTest();
  const BaseAndTool truth = AnyMounts(rng);
  auto rows = HexapodObservations(rng, truth, 3000);
  testing::AddNoise(rng, Isotropic(2e-4, 5e-3), &rows);
  const Estimate estimate = Calibrate(testing::UnknownNoise(rows), {}, {});
  EXPECT_TRUE(estimate.noise.estimated);
  EXPECT_NEAR(estimate.noise.position / 2e-4, 1.0, 0.03);
  EXPECT_NEAR(estimate.noise.orientation / 5e-3, 1.0, 0.03);
  EXPECT_NEAR(estimate.noise_scale, 1.0, 1e-9);  // the levels make it so
}

// With three poses the positions can always be met: of a position noise far below the orientation's
// the residuals say nothing, and the little that rounding leaves of them is not taken for it.
TEST(Noise, ALevelOfWhichTheDataSayNothingStaysAsItWas) {
  auto rng = SeededByTest();
  for (int i = 0; i < 50; ++i) {
    const BaseAndTool truth = AnyMounts(rng);
    auto rows = HexapodObservations(rng, truth, 3);
    testing::AddNoise(rng, Isotropic(1e-3, 0.1), &rows);
    const NoiseLevels start = {1e-12, 0.1};
    const NoiseLevels levels = EstimateNoise(testing::UnknownNoise(rows), truth, start);
    EXPECT_EQ(levels.position, start.position);
    EXPECT_GT(levels.orientation, 0.01);
    EXPECT_TRUE(std::isfinite(levels.orientation));
  }
}

// A noise that is stated, but not to be used, leaves nothing behind.
TEST(Noise, OfWhichNothingIsKnownIsThatOfTheLevelsAlone) {
  auto rng = SeededByTest();
  const BaseAndTool truth = AnyMounts(rng);
  auto rows = HexapodObservations(rng, truth, 4);
  testing::AddNoise(rng, Isotropic(1e-3, 0.1), &rows);
  for (Observation& o : rows) {
    const Matrix6d any = Matrix6d::Random();
    o.tool_covariance = any * any.transpose();
  }
  const Observations observations = testing::UnknownNoise(rows);
  Vector6d variances;
  variances << Eigen::Vector3d::Constant(4e-8), Eigen::Vector3d::Constant(9e-6);
  for (const Observation& o : observations.items)
    EXPECT_TRUE(ErrorCovariance(o, observations, truth.platform_from_tool, {2e-4, 3e-3})
                    .isApprox(Matrix6d(variances.asDiagonal()), 1e-14));
}

TEST(Noise, WithoutNoiseStaysAtRounding) {
  auto rng = SeededByTest();
  const BaseAndTool truth = AnyMounts(rng);
  const Estimate estimate =
      Calibrate(testing::UnknownNoise(HexapodObservations(rng, truth, 10)), {}, {});
  EXPECT_TRUE(estimate.converged);
  EXPECT_LT(estimate.noise.position, 1e-14);
  EXPECT_LT(estimate.noise.orientation, 1e-14);
}

}  // namespace
}  // namespace hexcal
