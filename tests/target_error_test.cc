// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/target_error.h"

#include <gtest/gtest.h>

#include <cmath>

#include "estimator/calibrate.h"
#include "estimator/error_length.h"
#include "testing/matchers.h"
#include "testing/scenes.h"

namespace hexcal {
namespace {

using ::hexcal::testing::JacobianNear;
using ::hexcal::testing::MatrixNear;
using ::hexcal::testing::NumericJacobian;
using ::hexcal::testing::SeededByTest;

const Eigen::Vector3d kTip(0.01, -0.02, 0.12);

// An estimate that is only sure of its size.
Estimate WithCovariance(const BaseAndTool& mounts, const Matrix12d& covariance) {
  Estimate estimate;
  estimate.mounts = mounts;
  estimate.converged = true;
  estimate.covariance = covariance;
  estimate.observability.determined.fill(true);
  estimate.intervals = IntervalsOfKnownNoise(covariance);
  return estimate;
}

TEST(TargetError, JacobianIsTheDerivative) {
  auto rng = SeededByTest();
  const BaseAndTool mounts = testing::AnyMounts(rng);
  const Pose3d pose = testing::RandomPose(rng, 0.3);
  const auto moved = [&](const Eigen::VectorXd& d) -> Eigen::VectorXd {
    return Plus(mounts.world_from_base, Vector6d(d.head<6>())) * pose *
           Plus(mounts.platform_from_tool, Vector6d(d.tail<6>())) * kTip;
  };
  EXPECT_TRUE(JacobianNear(TargetJacobian(mounts, pose, kTip), NumericJacobian(moved, 12), 1e-8));
}

// A base that may be turned about its z by 1 mrad moves a point 0.2 m off that axis by 0.2 mm,
// across the arm.
TEST(TargetError, OfOneAngleIsTheAngleTimesTheArm) {
  Matrix12d covariance = Matrix12d::Zero();
  covariance(5, 5) = 1e-6;
  const TargetError error(WithCovariance({}, covariance), {});
  const TargetCovariance at = error.At({}, {0.2, 0.0, 0.5});
  EXPECT_TRUE(
      MatrixNear(at.total, Eigen::Matrix3d(Eigen::Vector3d(0.0, 4e-8, 0.0).asDiagonal()), 1e-20));
  EXPECT_NEAR(at.Rms(), 2e-4, 1e-12);
  EXPECT_NEAR(at.Quantile(0.95), 1.959964 * 2e-4, 1e-8);
}

// Each source is what repetition makes of its small motion, at its own place.
TEST(TargetError, SourcesActWhereTheyAre) {
  auto rng = SeededByTest();
  const BaseAndTool mounts = testing::AnyMounts(rng);
  const Pose3d pose = testing::RandomPose(rng, 0.3);
  for (const SourceSite site :
       {SourceSite::kPlatform, SourceSite::kTool, SourceSite::kWorld, SourceSite::kPoint}) {
    const ErrorSource source = {"", site, 2e-4, site == SourceSite::kPoint ? 0.0 : 1e-3};
    const auto moved = [&](const Eigen::VectorXd& d) -> Eigen::VectorXd {
      const Vector6d step = d;
      const Pose3d turn = Plus(Pose3d{}, step);
      const bool is_platform = site == SourceSite::kPlatform, is_tool = site == SourceSite::kTool;
      const Eigen::Vector3d p =
          mounts.world_from_base * (is_platform ? Plus(pose, step) : pose) *
          (is_tool ? Plus(mounts.platform_from_tool, step) : mounts.platform_from_tool) * kTip;
      if (site == SourceSite::kWorld) return turn * p;
      return site == SourceSite::kPoint ? Eigen::Vector3d(p + step.head<3>()) : p;
    };
    const Eigen::MatrixXd j = NumericJacobian(moved, 6);
    Vector6d variance;
    variance << Eigen::Vector3d::Constant(source.position * source.position),
        Eigen::Vector3d::Constant(source.orientation * source.orientation);
    const TargetCovariance at =
        TargetError(WithCovariance(mounts, Matrix12d::Zero()), {source}).At(pose, kTip);
    EXPECT_TRUE(MatrixNear(at.total, j * variance.asDiagonal() * j.transpose(), 1e-12));
    EXPECT_EQ(at.shares[0], at.total);
  }
}

TEST(TargetError, SharesAddUpAndFewDegreesOfFreedomOfOneCountByItsShare) {
  const Matrix12d covariance = 1e-8 * Matrix12d::Identity();
  const ErrorSource sure = {"a", SourceSite::kPoint, 1e-4, 0.0};
  const ErrorSource unsure = {"b", SourceSite::kPoint, 1e-4, 0.0, Spread1d::kNormal, 5.0};
  const TargetCovariance at =
      TargetError(WithCovariance({}, covariance), {sure, unsure}).At({}, kTip);
  EXPECT_TRUE(MatrixNear(at.calibration + at.shares[0] + at.shares[1], at.total, 1e-20));
  const double share = at.shares[1].trace() / at.total.trace();
  EXPECT_NEAR(at.degrees_of_freedom, 5.0 / (share * share), 1e-6);
  const TargetCovariance alone =
      TargetError(WithCovariance({}, Matrix12d::Zero()), {unsure}).At({}, kTip);
  EXPECT_NEAR(alone.degrees_of_freedom, 5.0, 1e-9);
  EXPECT_NEAR(alone.Quantile(0.95), 1e-4 * std::sqrt(3 * 5.409451), 1e-9);  // F(3, 5)
}

// Another world frame and another origin of the base change nothing.
TEST(TargetError, IsInvariantUnderMotionOfTheWorld) {
  auto rng = SeededByTest();
  const BaseAndTool truth = testing::AnyMounts(rng);
  auto rows = testing::HexapodObservations(rng, truth, 12);
  testing::AddNoise(rng, testing::TrackerLikeCovariance(), &rows);
  const auto estimate = [&](const Pose3d& move) {
    auto moved = rows;
    for (Observation& o : moved) o.world_from_tool = move * o.world_from_tool;
    return Calibrate(testing::KnownNoise(moved, testing::TrackerLikeCovariance()), {}, {});
  };
  const Pose3d pose = rows[3].base_from_platform;
  const double here = TargetError(estimate({}), {}).At(pose, kTip).Quantile(0.95);
  for (int i = 0; i < 5; ++i) {
    const Estimate there = estimate(testing::RandomPose(rng, 1.0));
    EXPECT_NEAR(TargetError(there, {}).At(pose, kTip).Quantile(0.95) / here, 1.0, 1e-6);
  }
}

// Data without noise: an error of rounding, and of what else is stated.
TEST(TargetError, OfExactDataIsFinite) {
  const Estimate estimate = Calibrate(testing::UnknownNoise(testing::PaperObservations()), {}, {});
  const TargetCovariance at = TargetError(estimate, {{"a", SourceSite::kPoint, 1e-4}}).At({}, kTip);
  EXPECT_LT(std::sqrt(at.calibration.trace()), 1e-9);
  EXPECT_NEAR(at.Quantile(0.95), 2.795483e-4, 1e-9);
}

// How often the true error is shorter than the stated 95 % length, over whole calibrations.
class Coverage : public ::testing::TestWithParam<bool> {};

TEST_P(Coverage, OfTheStatedLengthIs95Percent) {
  constexpr int kDraws = 10000;
  const bool is_known = GetParam();
  auto rng = SeededByTest();
  const BaseAndTool truth = testing::AnyMounts(rng);
  const Matrix6d noise =
      is_known ? testing::TrackerLikeCovariance() : testing::Isotropic(1e-4, 4e-4);
  const auto clean = testing::HexapodObservations(rng, truth, is_known ? 10 : 7);
  const ErrorSource robot = {"robot", SourceSite::kPlatform, 1e-5, 5e-5};
  const Pose3d pose = testing::SmallPose(rng, 0.04, 0.3);
  int inside = 0;
  for (int i = 0; i < kDraws; ++i) {
    auto rows = clean;
    testing::AddNoise(rng, noise, &rows);
    const Estimate estimate = Calibrate(
        is_known ? testing::KnownNoise(rows, noise) : testing::UnknownNoise(rows), {}, {});
    const TargetCovariance at = TargetError(estimate, {robot}).At(pose, kTip);
    Vector6d step;
    step << 1e-5 * testing::Normal(rng, 3), 5e-5 * testing::Normal(rng, 3);
    const Eigen::Vector3d is =
        truth.world_from_base * Plus(pose, step) * truth.platform_from_tool * kTip;
    // As length <= at.Quantile(0.95), and quicker.
    const double length = (at.p_in_world - is).norm();
    inside += LengthTail(at.total, length, at.degrees_of_freedom) >= 0.05;
  }
  const double share = static_cast<double>(inside) / kDraws;
  EXPECT_GE(share, 0.94);
  EXPECT_LE(share, 0.96);
  RecordProperty("coverage", std::to_string(share));
}

INSTANTIATE_TEST_SUITE_P(Noise, Coverage, ::testing::Values(true, false), [](const auto& tested) {
  return tested.param ? "Stated" : "Estimated";
});

}  // namespace
}  // namespace hexcal
