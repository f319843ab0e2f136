// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/target_check.h"

#include <gtest/gtest.h>

#include <cmath>

#include "estimator/calibrate.h"
#include "testing/scenes.h"

namespace hexcal {
namespace {

using ::hexcal::testing::SeededByTest;

const Eigen::Vector3d kTip(0.01, -0.02, 0.12);

struct Scene {
  Observations observations;
  Estimate estimate;
  PropagationCheck propagation;
};

Scene MakeScene(double position, double orientation) {
  auto rng = SeededByTest();
  const BaseAndTool truth = testing::AnyMounts(rng);
  auto rows = testing::HexapodObservations(rng, truth, 20);
  const Matrix6d noise = testing::Isotropic(position, orientation);
  testing::AddNoise(rng, noise, &rows);
  Scene scene;
  scene.observations = testing::KnownNoise(rows, noise);
  scene.estimate = Calibrate(scene.observations, {}, {});
  MonteCarloOptions options;
  options.keep_draws = true;
  scene.propagation = CheckPropagation(scene.observations, {}, scene.estimate, options);
  return scene;
}

TEST(TargetCheck, FirstOrderAndRepetitionAgreeWhereNoiseIsSmall) {
  const Scene scene = MakeScene(1e-4, 5e-4);
  ASSERT_EQ(scene.propagation.estimates.cols(), scene.propagation.draws);
  const std::vector<ErrorSource> sources = {
      {"robot", SourceSite::kPlatform, 2e-5, 1e-4},
      {"registration", SourceSite::kWorld, 5e-5, 2e-4},
      {"clamping", SourceSite::kTool, 1e-5, 1e-4, Spread1d::kUniform},
      {"tip", SourceSite::kPoint, 5e-5, 0.0, Spread1d::kUniform}};
  const Pose3d pose = scene.observations.items[3].base_from_platform;
  const TargetCheck check =
      CheckTarget(scene.estimate, sources, scene.propagation, pose, kTip, 0.95, 1);
  EXPECT_NEAR(check.repeated_rms / check.rms, 1.0, 0.02);
  EXPECT_NEAR(check.repeated_quantile / check.quantile, 1.0, 0.03);
  EXPECT_TRUE(check.agrees);
  EXPECT_NEAR(static_cast<double>(check.inside) / check.draws, 0.95, 0.01);
  EXPECT_LT(check.standard_error, 0.02 * check.quantile);
  EXPECT_GT(check.standard_error, 0.0);
}

// A statement that repetition contradicts is found; one that chance or few degrees of freedom
// explain is none.
TEST(TargetCheck, SeesAStatementThatIsTooShort) {
  const Scene scene = MakeScene(1e-4, 5e-4);
  const Pose3d pose = scene.observations.items[3].base_from_platform;
  const auto check = [&](double length, double degrees_of_freedom) {
    return CheckTarget(scene.estimate,
                       {},
                       scene.propagation,
                       pose,
                       kTip,
                       0.95,
                       1,
                       nullptr,
                       {length, degrees_of_freedom});
  };
  const TargetCheck none = check(0.0, 1.0);
  EXPECT_FALSE(none.exceeds_stated);
  const double known = static_cast<double>(scene.estimate.degrees_of_freedom);
  EXPECT_FALSE(check(none.quantile, known).exceeds_stated);
  EXPECT_TRUE(check(0.7 * none.quantile, known).exceeds_stated);
  EXPECT_LT(check(0.7 * none.quantile, known).inside_stated, 0.9 * none.draws);
  EXPECT_FALSE(check(0.7 * none.quantile, 6.0).exceeds_stated);
}

// Angles of half a radian bend what first order takes for straight.
TEST(TargetCheck, SeesWhatFirstOrderMisses) {
  const Scene scene = MakeScene(1e-4, 5e-4);
  const std::vector<ErrorSource> sources = {{"loose", SourceSite::kPlatform, 0.0, 0.6}};
  const Pose3d pose = scene.observations.items[3].base_from_platform;
  const TargetCheck check =
      CheckTarget(scene.estimate, sources, scene.propagation, pose, kTip, 0.95, 1);
  EXPECT_FALSE(check.agrees);
  EXPECT_LT(check.repeated_quantile, check.quantile);
}

// A tip that is known by pivoting: along one axis of the tool three times less well. Its share is
// turned with the tool, and repetition finds it.
TEST(TargetCheck, CarriesTheCovarianceOfAPointOfTheTool) {
  const Scene scene = MakeScene(1e-6, 5e-6);
  const Pose3d pose = scene.observations.items[3].base_from_platform;
  Eigen::Matrix3d covariance;
  covariance << 1.0, 0.3, 0.0, 0.3, 1.0, 0.2, 0.0, 0.2, 9.0;
  ErrorSource tip{"tip", SourceSite::kPointInTool};
  tip.covariance_in_tool = 1e-8 * covariance;
  const TargetCheck check =
      CheckTarget(scene.estimate, {tip}, scene.propagation, pose, kTip, 0.95, 1);
  EXPECT_NEAR(check.rms, 1e-4 * std::sqrt(11.0), 1e-6);
  EXPECT_NEAR(check.repeated_rms / check.rms, 1.0, 0.02);
  EXPECT_NEAR(check.repeated_quantile / check.quantile, 1.0, 0.03);
  EXPECT_TRUE(check.agrees);

  const BaseAndTool& mounts = scene.estimate.mounts;
  const Eigen::Matrix3d turn =
      (mounts.world_from_base * pose * mounts.platform_from_tool).rotation.toRotationMatrix();
  const TargetCovariance at = TargetError(scene.estimate, {tip}).At(pose, kTip);
  const Eigen::Matrix3d back = turn.transpose() * at.shares[0] * turn;
  EXPECT_LT((back - *tip.covariance_in_tool).norm(), 1e-20);
}

// Every source counts: without its motion the repetition would be shorter.
TEST(TargetCheck, DrawsEverySource) {
  const Scene scene = MakeScene(1e-6, 5e-6);
  const Pose3d pose = scene.observations.items[3].base_from_platform;
  for (const SourceSite site :
       {SourceSite::kPlatform, SourceSite::kTool, SourceSite::kWorld, SourceSite::kPoint})
    for (const Spread1d spread : {Spread1d::kNormal, Spread1d::kUniform}) {
      const std::vector<ErrorSource> sources = {{"one", site, 1e-3, 1e-3, spread}};
      const TargetCheck check =
          CheckTarget(scene.estimate, sources, scene.propagation, pose, kTip, 0.95, 1);
      EXPECT_NEAR(check.repeated_rms / check.rms, 1.0, 0.02);
    }
}

}  // namespace
}  // namespace hexcal
