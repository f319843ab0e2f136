// SPDX-License-Identifier: BSD-3-Clause
// What pivoting says of its own accuracy, over many draws.
#include <gtest/gtest.h>

#include "estimator/pivot.h"
#include "estimator/quantiles.h"
#include "geometry/linear_algebra.h"
#include "testing/pivot_scene.h"

namespace hexcal {
namespace {

using ::hexcal::testing::DrawPivotPoses;
using ::hexcal::testing::IsotropicNoise;
using ::hexcal::testing::PivotScene;
using ::hexcal::testing::SeededByTest;
using ::hexcal::testing::WithNoise;

const Matrix6d kNoise = IsotropicNoise(1e-4, 1e-3);

std::vector<bool> All(const PivotPoses& poses) {
  return std::vector<bool>(poses.items.size(), true);
}

Eigen::Vector3d TipOff(const PivotSolution& solution, const PivotScene& pivoting) {
  return solution.fit.x.tip_in_tool - pivoting.truth.tip_in_tool;
}

// Of the tip at once, and of each of the six alone.
struct Coverage {
  double region = 0.0;
  Vector6d intervals = Vector6d::Zero();
};

template <typename Rng>
Coverage Cover(
    const PivotScene& pivoting, const PivotPoses& clean, PivotNoise noise, int draws, Rng& rng) {
  Coverage coverage;
  Vector6d truth;
  truth << pivoting.truth.tip_in_tool, pivoting.truth.pivot_in_world;
  for (int k = 0; k < draws; ++k) {
    PivotPoses poses = WithNoise(clean, rng);
    poses.noise = noise;
    const PivotSolution s = SolvePivot(poses, All(poses), {});
    Vector6d off;
    off << s.fit.x.tip_in_tool, s.fit.x.pivot_in_world;
    off -= truth;
    const Eigen::Vector3d d = off.head<3>();
    const double squared = d.dot(s.covariance.topLeftCorner<3, 3>().inverse() * d);
    coverage.region +=
        squared <= 3.0 * FisherFQuantile(0.95, 3.0, std::min(s.tip_degrees_of_freedom, 1e7));
    for (int i = 0; i < 6; ++i)
      coverage.intervals[i] +=
          std::abs(off[i]) <= StudentTQuantile(0.975, std::min(s.degrees_of_freedom[i], 1e7)) *
                                  std::sqrt(s.covariance(i, i));
  }
  coverage.region /= draws;
  coverage.intervals /= draws;
  return coverage;
}

void ExpectCovers(const Coverage& coverage) {
  EXPECT_GT(coverage.region, 0.94);
  EXPECT_LT(coverage.region, 0.96);
  EXPECT_GT(coverage.intervals.minCoeff(), 0.935);
  EXPECT_LT(coverage.intervals.maxCoeff(), 0.965);
}

TEST(Pivot, StatedNoiseCovers) {
  auto rng = SeededByTest();
  PivotScene pivoting;
  pivoting.poses = 15;
  Matrix6d noise = IsotropicNoise(1e-4, 1e-3);
  noise(2, 2) *= 9.0;
  noise(2, 3) = noise(3, 2) = 1e-7;
  const PivotPoses clean = DrawPivotPoses(pivoting, noise, rng);
  ExpectCovers(Cover(pivoting, clean, PivotNoise::kKnown, 6000, rng));
  ExpectCovers(Cover(pivoting, clean, PivotNoise::kUpToScale, 4000, rng));
}

TEST(Pivot, EstimatedNoiseCovers) {
  auto rng = SeededByTest();
  PivotScene pivoting;
  pivoting.poses = 40;
  const PivotPoses clean = DrawPivotPoses(pivoting, kNoise, rng);
  ExpectCovers(Cover(pivoting, clean, PivotNoise::kUnknown, 3000, rng));
}

// Noise in the rotations shrinks what least squares on [R -1] finds; not this.
TEST(Pivot, NoiseInRotationsDoesNotShrinkTheTip) {
  auto rng = SeededByTest();
  PivotScene pivoting;
  pivoting.poses = 200;
  pivoting.cone = 0.1;
  const PivotPoses clean = DrawPivotPoses(pivoting, IsotropicNoise(1e-4, 1e-2), rng);
  constexpr int kDraws = 200;
  double own = 0.0, own_squares = 0.0, algebraic = 0.0;
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < clean.items.size(); ++i) indices.push_back(i);
  for (int k = 0; k < kDraws; ++k) {
    const PivotPoses poses = WithNoise(clean, rng);
    const double off = TipOff(SolvePivot(poses, All(poses), {}), pivoting).z();
    own += off / kDraws, own_squares += off * off / kDraws;
    algebraic += (SolvePivotAlgebraically(poses.items, indices, Eigen::Matrix3d::Identity())
                      .tip_in_tool.z() -
                  pivoting.truth.tip_in_tool.z()) /
                 kDraws;
  }
  const double standard_error = std::sqrt(own_squares / kDraws);
  EXPECT_LT(std::abs(own), 4.0 * standard_error);
  EXPECT_LT(algebraic, -20.0 * standard_error);
}

TEST(Pivot, EstimatesTheNoise) {
  auto rng = SeededByTest();
  const PivotPoses clean = DrawPivotPoses({}, kNoise, rng);
  constexpr int kDraws = 400;
  double position = 0.0, orientation = 0.0, scale = 0.0;
  for (int k = 0; k < kDraws; ++k) {
    PivotPoses poses = WithNoise(clean, rng);
    poses.noise = PivotNoise::kUnknown;
    const PivotSolution levels = SolvePivot(poses, All(poses), {});
    position += std::pow(levels.position_noise, 2) / kDraws;
    orientation += std::pow(levels.orientation_noise, 2) / kDraws;
    poses.noise = PivotNoise::kUpToScale;
    for (PivotPose& pose : poses.items) pose.covariance *= 0.01;
    scale += std::pow(SolvePivot(poses, All(poses), {}).noise_scale, 2) / kDraws;
  }
  EXPECT_NEAR(std::sqrt(position), 1e-4, 2e-6);
  EXPECT_NEAR(std::sqrt(orientation), 1e-3, 1e-5);
  EXPECT_NEAR(std::sqrt(scale), 10.0, 0.1);
}

}  // namespace
}  // namespace hexcal
