// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/rejection.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "estimator/calibrate.h"
#include "testing/matchers.h"
#include "testing/outliers.h"
#include "testing/scenes.h"

namespace hexcal {
namespace {

using testing::AnyMounts;
using testing::SeededByTest;
using testing::UnknownNoise;

constexpr NoiseLevels kNoise = {1e-4, 2e-4};

template <typename Rng>
std::vector<Observation> NoisyRows(Rng& rng, int poses) {
  std::vector<Observation> rows = testing::HexapodObservations(rng, AnyMounts(rng), poses);
  Vector6d sigma;
  sigma << Eigen::Vector3d::Constant(kNoise.position),
      Eigen::Vector3d::Constant(kNoise.orientation);
  testing::AddNoise(rng, Matrix6d(sigma.cwiseAbs2().asDiagonal()), &rows);
  return rows;
}

// So that of all the clean draws here none lists an outlier by chance.
constexpr double kAlpha = 1e-5;

CalibrateOptions With(OutlierHandling handling) {
  CalibrateOptions options;
  options.outliers = handling;
  options.snooping.alpha = kAlpha;
  return options;
}

// Bit by bit.
void ExpectSame(const Estimate& a, const Estimate& b) {
  EXPECT_EQ(a.mounts.world_from_base.translation, b.mounts.world_from_base.translation);
  EXPECT_EQ(a.mounts.world_from_base.rotation.coeffs(), b.mounts.world_from_base.rotation.coeffs());
  EXPECT_EQ(a.mounts.platform_from_tool.translation, b.mounts.platform_from_tool.translation);
  EXPECT_EQ(a.covariance, b.covariance);
  EXPECT_EQ(a.chi_square, b.chi_square);
  EXPECT_EQ(a.noise.position, b.noise.position);
}

TEST(Rejection, ChangesNothingWhereThereIsNoOutlier) {
  auto rng = SeededByTest();
  for (int k = 0; k < 10; ++k) {
    const Observations clean = UnknownNoise(NoisyRows(rng, 30));
    const Estimate plain = Calibrate(clean, {}, {});
    for (const OutlierHandling handling : {OutlierHandling::kKeep, OutlierHandling::kReject}) {
      const Estimate estimate = Calibrate(clean, {}, With(handling));
      ExpectSame(estimate, plain);
      EXPECT_TRUE(estimate.outliers.empty());
      EXPECT_EQ(estimate.warnings, plain.warnings);
    }
  }
}

TEST(Rejection, LeavesOutliersOutAndKeepsTheirPlace) {
  auto rng = SeededByTest();
  const std::vector<Observation> rows = NoisyRows(rng, 20);
  Observations all = UnknownNoise(rows), others = all;
  for (const std::size_t i : {0, 12, 19})
    all.items[i].world_from_tool.translation.x() += 60.0 * kNoise.position;
  for (const std::size_t i : {19, 12, 0}) others.items.erase(others.items.begin() + i);
  const Estimate estimate = Calibrate(all, {}, With(OutlierHandling::kReject));
  ExpectSame(estimate, Calibrate(others, {}, {}));
  ASSERT_EQ(estimate.outliers.size(), 3u);
  EXPECT_EQ(estimate.outliers[1].label, "13");
  ASSERT_EQ(estimate.poses.size(), 20u);
  for (std::size_t i = 0; i < 20; ++i) {
    const PoseResult& pose = estimate.poses[i];
    EXPECT_EQ(pose.label, rows[i].label);
    const bool is_out = i == 0 || i == 12 || i == 19;
    EXPECT_EQ(pose.weight, is_out ? 0.0 : 1.0);
    EXPECT_EQ(pose.residual.norm() > 30.0 * kNoise.position, is_out);
    EXPECT_EQ(
        pose.residual,
        PoseError(estimate.mounts, all.items[i].base_from_platform, all.items[i].world_from_tool));
  }
  EXPECT_EQ(estimate.warnings.back(), "3 of 20 poses left out as outliers: 1, 13, 20");
}

TEST(Rejection, KeepListsThemAndUsesThem) {
  auto rng = SeededByTest();
  Observations all = UnknownNoise(NoisyRows(rng, 20));
  all.items[6].world_from_tool.translation.x() += 60.0 * kNoise.position;
  const Estimate estimate = Calibrate(all, {}, With(OutlierHandling::kKeep));
  ExpectSame(estimate, Calibrate(all, {}, {}));
  ASSERT_EQ(estimate.outliers.size(), 1u);
  EXPECT_EQ(estimate.outliers[0].label, "7");
  EXPECT_EQ(estimate.poses[6].weight, 1.0);
  EXPECT_EQ(
      estimate.warnings.back().rfind("pose 7 looks like an outlier, but is used: position 5", 0),
      0u)
      << estimate.warnings.back();
}

TEST(Rejection, ManyOutliersAreSaidToBeMany) {
  auto rng = SeededByTest();
  Observations all = UnknownNoise(NoisyRows(rng, 40));
  testing::SpoilGrossly(rng, testing::DrawIndices(rng, 14, 40), kNoise, &all.items);
  const Estimate estimate = Calibrate(all, {}, With(OutlierHandling::kReject));
  EXPECT_NE(estimate.warnings.back().find("outliers among 40 poses are many"), std::string::npos);
}

// The cheap look at the residuals must not overlook what the search finds.
TEST(Rejection, WhatIsFoundWasSuspicious) {
  auto rng = SeededByTest();
  int found = 0, not_suspicious = 0;
  for (int k = 0; k < 40; ++k) {
    Observations all = UnknownNoise(NoisyRows(rng, k % 2 == 0 ? 20 : 200));
    testing::Spoil(rng,
                   k % 3 == 0 ? testing::Spoilt::kPosition : testing::Spoilt::kOrientation,
                   testing::Uniform(rng, 4.0, 8.0),
                   kNoise,
                   &all.items[3]);
    if (FindOutliers(all, {}, {}).outliers.empty()) continue;
    ++found;
    EXPECT_TRUE(MayHoldOutliers(all, {}, Calibrate(all, {}, {}).mounts, {})) << k;
  }
  EXPECT_GE(found, 15);
  for (int k = 0; k < 20; ++k) {
    const Observations clean = UnknownNoise(NoisyRows(rng, 300));
    not_suspicious += !MayHoldOutliers(clean, {}, Calibrate(clean, {}, {}).mounts, {});
  }
  EXPECT_GE(not_suspicious, 15);
}

}  // namespace
}  // namespace hexcal
