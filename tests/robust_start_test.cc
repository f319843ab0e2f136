// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/robust_start.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "testing/matchers.h"
#include "testing/outliers.h"
#include "testing/scenes.h"

namespace hexcal {
namespace {

using testing::AnyMounts;
using testing::HexapodObservations;
using testing::Isotropic;
using testing::PoseNear;
using testing::SeededByTest;

constexpr NoiseLevels kNoise = {1e-4, 2e-4};

TEST(RobustStart, IsExactWhereMoreThanHalfOfThePosesAre) {
  auto rng = SeededByTest();
  for (int k = 0; k < 10; ++k) {
    const BaseAndTool truth = AnyMounts(rng);
    std::vector<Observation> rows = HexapodObservations(rng, truth, 20);
    for (const std::size_t i : testing::DrawIndices(rng, 8, 20))
      rows[i].world_from_tool = testing::RandomPose(rng, 1.0);
    const RobustStart start = FindRobustStart(testing::UnknownNoise(rows), {});
    EXPECT_TRUE(PoseNear(start.mounts.world_from_base, truth.world_from_base, 1e-9, 1e-9));
    EXPECT_TRUE(PoseNear(start.mounts.platform_from_tool, truth.platform_from_tool, 1e-9, 1e-9));
    EXPECT_LT(start.levels.position, 1e-12);
  }
}

TEST(RobustStart, FortyPercentOfGrossOutliersDoNotSpoilIt) {
  auto rng = SeededByTest();
  for (int k = 0; k < 30; ++k) {
    const BaseAndTool truth = AnyMounts(rng);
    std::vector<Observation> rows = HexapodObservations(rng, truth, 60);
    testing::AddNoise(rng, Isotropic(kNoise), &rows);
    const auto bad = testing::DrawIndices(rng, 24, 60);
    for (const std::size_t i : bad)
      testing::Spoil(rng,
                     static_cast<testing::Spoilt>(rng() % 3),
                     testing::Uniform(rng, 20.0, 100.0),
                     kNoise,
                     &rows[i]);
    const RobustStart start = FindRobustStart(testing::UnknownNoise(rows), {});
    EXPECT_LT(testing::Difference(start.mounts, truth).cwiseAbs().maxCoeff(), 1e-2);
    for (const std::size_t i : bad)
      EXPECT_EQ(std::count(start.nearest.begin(), start.nearest.end(), i), 0) << i;
    EXPECT_GT(start.levels.position, 0.8 * kNoise.position);
    EXPECT_LT(start.levels.position, 2.0 * kNoise.position);
    EXPECT_GT(start.levels.orientation, 0.8 * kNoise.orientation);
    EXPECT_LT(start.levels.orientation, 2.0 * kNoise.orientation);
  }
}

TEST(RobustStart, LevelsOfCleanPosesAreUnbiased) {
  auto rng = SeededByTest();
  double position = 0.0, orientation = 0.0;
  constexpr int kDraws = 50;
  for (int k = 0; k < kDraws; ++k) {
    std::vector<Observation> rows = HexapodObservations(rng, AnyMounts(rng), 60);
    testing::AddNoise(rng, Isotropic(kNoise), &rows);
    const RobustStart start = FindRobustStart(testing::UnknownNoise(rows), {});
    position += start.levels.position / kNoise.position / kDraws;
    orientation += start.levels.orientation / kNoise.orientation / kDraws;
  }
  EXPECT_NEAR(position, 1.0, 0.1);
  EXPECT_NEAR(orientation, 1.0, 0.1);
}

// Position and orientation errors have no common unit.
TEST(RobustStart, UnitsDoNotMatter) {
  auto rng = SeededByTest();
  for (int k = 0; k < 10; ++k) {
    std::vector<Observation> rows = HexapodObservations(rng, AnyMounts(rng), 30);
    testing::AddNoise(rng, Isotropic(kNoise), &rows);
    testing::SpoilGrossly(rng, testing::DrawIndices(rng, 9, 30), kNoise, &rows);
    const RobustStart in_metres = FindRobustStart(testing::UnknownNoise(rows), {});
    for (Observation& o : rows) {
      o.base_from_platform.translation *= 1e3;
      o.world_from_tool.translation *= 1e3;
    }
    const RobustStart in_millimetres = FindRobustStart(testing::UnknownNoise(rows), {});
    EXPECT_EQ(in_metres.nearest, in_millimetres.nearest);
    EXPECT_NEAR(in_millimetres.levels.position / in_metres.levels.position, 1e3, 1e-6);
  }
}

TEST(RobustStart, StatedNoiseWeighsTheErrors) {
  auto rng = SeededByTest();
  const Matrix6d covariance = testing::TrackerLikeCovariance();
  const BaseAndTool truth = AnyMounts(rng);
  std::vector<Observation> rows = HexapodObservations(rng, truth, 40);
  testing::AddNoise(rng, covariance, &rows);
  const Matrix6d l = covariance.llt().matrixL();
  const auto bad = testing::DrawIndices(rng, 14, 40);
  for (const std::size_t i : bad)
    rows[i].world_from_tool =
        Plus(rows[i].world_from_tool, Vector6d(l * 30.0 * testing::Normal(rng, 6).normalized()));
  const RobustStart start = FindRobustStart(testing::KnownNoise(rows, covariance), {});
  for (const std::size_t i : bad)
    EXPECT_EQ(std::count(start.nearest.begin(), start.nearest.end(), i), 0) << i;
}

}  // namespace
}  // namespace hexcal
