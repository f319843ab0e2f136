// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/outliers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include "estimator/calibrate.h"
#include "estimator/deletion.h"
#include "estimator/normal_matrix.h"
#include "estimator/polish.h"
#include "estimator/subset_fit.h"
#include "residuals/whitener.h"
#include "testing/matchers.h"
#include "testing/outliers.h"
#include "testing/scenes.h"

namespace hexcal {
namespace {

using testing::AnyMounts;
using testing::Difference;
using testing::DrawIndices;
using testing::HexapodObservations;
using testing::Isotropic;
using testing::KnownNoise;
using testing::SeededByTest;
using testing::Spoil;
using testing::Spoilt;
using testing::UnknownNoise;

constexpr NoiseLevels kNoise = {1e-4, 2e-4};

template <typename Rng>
std::vector<Observation> NoisyRows(Rng& rng, const BaseAndTool& truth, int poses) {
  std::vector<Observation> rows = HexapodObservations(rng, truth, poses);
  testing::AddNoise(rng, Isotropic(kNoise), &rows);
  return rows;
}

std::vector<std::size_t> Found(const Observations& observations, double alpha = 0.01) {
  std::vector<std::size_t> indices;
  for (const Outlier& outlier : FindOutliers(observations, {}, {alpha}).outliers)
    indices.push_back(outlier.index);
  return indices;
}

// The fit to some rows and its covariance.
struct Fitted {
  BaseAndTool mounts;
  Matrix12d covariance;
};
Fitted FitTo(const std::vector<Observation>& rows, const BaseAndTool& near, const Matrix6d& noise) {
  const std::vector<Matrix6d> whiteners(rows.size(), WhitenerOf(noise));
  Fitted fitted{Polish(rows, whiteners, near), Matrix12d::Zero()};
  Matrix12d normal = Matrix12d::Zero();
  for (const Observation& o : rows) {
    const Matrix6x12d j = WhitenerOf(noise) * Linearise(o, fitted.mounts).jacobian;
    normal += j.transpose() * j;
  }
  fitted.covariance = InverseOfNormal(normal);
  return fitted;
}

// With tiny errors the problem is linear and the identity exact: it must be the error against a fit
// that really went without the pose.
TEST(DeletionError, IsTheErrorOfAPoseLeftOut) {
  auto rng = SeededByTest();
  const BaseAndTool truth = AnyMounts(rng);
  std::vector<Observation> rows = HexapodObservations(rng, truth, 8);
  const Matrix6d noise = 1e-8 * testing::TrackerLikeCovariance();
  testing::AddNoise(rng, noise, &rows);
  const Fitted with = FitTo(rows, truth, noise);
  const Observation pose = rows[3];
  rows.erase(rows.begin() + 3);
  const Fitted without = FitTo(rows, truth, noise);
  const auto by_identity =
      ErrorAgainstOthers(Linearise(pose, with.mounts), noise, with.covariance, true);
  const auto by_refit =
      ErrorAgainstOthers(Linearise(pose, without.mounts), noise, without.covariance, false);
  ASSERT_TRUE(by_identity && by_refit);
  const Matrix6d w = WhitenerOf(noise);
  EXPECT_TRUE(testing::MatrixNear(w * by_identity->error, w * by_refit->error, 1e-5));
  EXPECT_TRUE(testing::MatrixNear(
      w * by_identity->covariance * w.transpose(), w * by_refit->covariance * w.transpose(), 1e-5));
  EXPECT_NEAR(by_identity->Squared(), by_refit->Squared(), 1e-5);
}

TEST(DeletionError, NothingWhereThePoseAloneDeterminesADirection) {
  auto rng = SeededByTest();
  const BaseAndTool truth = AnyMounts(rng);
  const std::vector<Observation> rows = HexapodObservations(rng, truth, 2);
  const Fitted fitted = FitTo(rows, truth, Isotropic(kNoise));
  EXPECT_FALSE(ErrorAgainstOthers(
      Linearise(rows[0], fitted.mounts), Isotropic(kNoise), fitted.covariance, true));
}

// Of the draws without outliers a share alpha lists some; 4 standard deviations of a count.
void ExpectFalseAlarms(int poses, bool noise_is_stated, std::mt19937_64 rng) {
  constexpr int kDraws = 150;
  constexpr double kAlpha = 0.1;
  int alarms = 0;
  for (int k = 0; k < kDraws; ++k) {
    const std::vector<Observation> rows = NoisyRows(rng, AnyMounts(rng), poses);
    alarms +=
        !Found(noise_is_stated ? KnownNoise(rows, Isotropic(kNoise)) : UnknownNoise(rows), kAlpha)
             .empty();
  }
  EXPECT_NEAR(alarms, kAlpha * kDraws, 4.0 * std::sqrt(kAlpha * (1.0 - kAlpha) * kDraws));
}

TEST(Outliers, FalseAlarmsAreAsManyAsAlphaSays) {
  ExpectFalseAlarms(60, true, SeededByTest());
  ExpectFalseAlarms(60, false, SeededByTest());
  ExpectFalseAlarms(10, true, SeededByTest());
}

TEST(Outliers, FindOneOfEightSigmaAmongTwenty) {
  auto rng = SeededByTest();
  for (const bool noise_is_stated : {true, false}) {
    int found = 0;
    for (int k = 0; k < 30; ++k) {
      std::vector<Observation> rows = NoisyRows(rng, AnyMounts(rng), 20);
      Spoil(rng, k % 2 == 0 ? Spoilt::kPosition : Spoilt::kOrientation, 8.0, kNoise, &rows[5]);
      const auto search = FindOutliers(
          noise_is_stated ? KnownNoise(rows, Isotropic(kNoise)) : UnknownNoise(rows), {}, {});
      for (const Outlier& outlier : search.outliers) {
        if (outlier.index != 5) continue;
        ++found;
        EXPECT_EQ(outlier.label, "6");
        EXPECT_LT(outlier.p_value, 0.01);
        const std::string part = k % 2 == 0 ? "position" : "orientation";
        EXPECT_EQ(outlier.reason.rfind(part, 0), 0u) << outlier.reason;
        EXPECT_NEAR(k % 2 == 0 ? outlier.position_sigmas : outlier.orientation_sigmas, 7.6, 3.5);
      }
    }
    EXPECT_GE(found, 29);
  }
}

TEST(Outliers, SayHowFarAlongWhichAxis) {
  auto rng = SeededByTest();
  std::vector<Observation> rows = NoisyRows(rng, AnyMounts(rng), 30);
  Vector6d move = Vector6d::Zero();
  move[1] = 40e-3;
  move[5] = 0.05;
  rows[7].world_from_tool = Plus(rows[7].world_from_tool, move);
  const auto outliers = FindOutliers(KnownNoise(rows, Isotropic(kNoise)), {}, {}).outliers;
  ASSERT_EQ(outliers.size(), 1u);
  EXPECT_NE(outliers[0].reason.find("position 3"), std::string::npos) << outliers[0].reason;
  EXPECT_NE(outliers[0].reason.find("mm), most along y of the tool; orientation 2"),
            std::string::npos)
      << outliers[0].reason;
  EXPECT_NE(outliers[0].reason.find("deg), most about z of the tool"), std::string::npos)
      << outliers[0].reason;
  EXPECT_TRUE(testing::MatrixNear(outliers[0].residual, move, 1e-3));
}

// One hides the other (masking), and together they draw the fit to themselves and away from clean
// poses (swamping): a fixed error in 18 of 60, as of a tool that was bumped.
TEST(Outliers, FindThoseThatAgreeWithEachOther) {
  auto rng = SeededByTest();
  for (int k = 0; k < 10; ++k) {
    std::vector<Observation> rows = NoisyRows(rng, AnyMounts(rng), 60);
    const auto bad = DrawIndices(rng, 18, 60);
    Vector6d move;
    move << 30.0 * kNoise.position * testing::Normal(rng, 3).normalized(),
        30.0 * kNoise.orientation * testing::Normal(rng, 3).normalized();
    for (const std::size_t i : bad) rows[i].world_from_tool = Plus(rows[i].world_from_tool, move);
    EXPECT_EQ(Found(UnknownNoise(rows), 1e-4), bad);
    EXPECT_EQ(Found(KnownNoise(rows, Isotropic(kNoise)), 1e-4), bad);
  }
}

// The large version is benchmarks/robust_study.
TEST(Outliers, ThirtyPercentOfThemCostLittleAccuracy) {
  auto rng = SeededByTest();
  double squared = 0.0, squared_of_clean = 0.0;
  for (int k = 0; k < 40; ++k) {
    const BaseAndTool truth = AnyMounts(rng);
    std::vector<Observation> rows = NoisyRows(rng, truth, 60);
    const auto bad = DrawIndices(rng, 18, 60);
    std::vector<Observation> clean;
    for (std::size_t i = 0; i < rows.size(); ++i)
      if (!std::binary_search(bad.begin(), bad.end(), i)) clean.push_back(rows[i]);
    testing::SpoilGrossly(rng, bad, kNoise, &rows);
    const Observations all = UnknownNoise(rows);
    const Observations others = Without(all, FindOutliers(all, {}, {}).outliers);
    const Estimate of_clean = Calibrate(UnknownNoise(clean), {}, {});
    const Matrix12d weight = of_clean.covariance.inverse();
    const Vector12d error = Difference(Calibrate(others, {}, {}).mounts, truth);
    const Vector12d error_of_clean = Difference(of_clean.mounts, truth);
    squared += error.dot(weight * error);
    squared_of_clean += error_of_clean.dot(weight * error_of_clean);
  }
  EXPECT_LT(std::sqrt(squared / squared_of_clean), 1.15);
}

TEST(Outliers, NoneInExactData) {
  auto rng = SeededByTest();
  std::vector<Observation> rows = HexapodObservations(rng, AnyMounts(rng), 12);
  EXPECT_TRUE(Found(UnknownNoise(rows)).empty());
  rows[4].world_from_tool.translation.x() += 1e-9;
  EXPECT_EQ(Found(UnknownNoise(rows)), std::vector<std::size_t>{4});
}

TEST(Outliers, NotSoughtAmongFewerThanSix) {
  auto rng = SeededByTest();
  std::vector<Observation> rows = NoisyRows(rng, AnyMounts(rng), 5);
  rows[1].world_from_tool.translation.x() += 1.0;
  EXPECT_TRUE(Found(KnownNoise(rows, Isotropic(kNoise))).empty());
}

// Five times too small, which would make every pose an outlier.
TEST(Outliers, StatedNoiseThatAllDisproveIsScaled) {
  auto rng = SeededByTest();
  std::vector<Observation> rows = NoisyRows(rng, AnyMounts(rng), 40);
  EXPECT_TRUE(Found(KnownNoise(rows, Isotropic(kNoise) / 25.0)).empty());
  Spoil(rng, Spoilt::kBoth, 30.0, kNoise, &rows[11]);
  EXPECT_EQ(Found(KnownNoise(rows, Isotropic(kNoise) / 25.0)), std::vector<std::size_t>{11});
}

TEST(Outliers, DoNotDependOnTheOrderOfTheRows) {
  auto rng = SeededByTest();
  std::vector<Observation> rows = NoisyRows(rng, AnyMounts(rng), 40);
  testing::SpoilGrossly(rng, DrawIndices(rng, 12, 40), kNoise, &rows);
  std::vector<std::string> labels, labels_of_shuffled;
  for (const Outlier& o : FindOutliers(UnknownNoise(rows), {}, {}).outliers)
    labels.push_back(o.label);
  std::shuffle(rows.begin(), rows.end(), rng);
  for (const Outlier& o : FindOutliers(UnknownNoise(rows), {}, {}).outliers)
    labels_of_shuffled.push_back(o.label);
  std::sort(labels.begin(), labels.end());
  std::sort(labels_of_shuffled.begin(), labels_of_shuffled.end());
  EXPECT_GE(labels.size(), 9u);
  EXPECT_EQ(labels, labels_of_shuffled);
}

// What was taken out too early comes back: no pose that is listed agrees with the others. Noise
// with long tails besides gross outliers; this is a draw in which one does come back.
TEST(Outliers, ContradictTheOthersToTheEnd) {
  std::mt19937_64 rng(7);
  std::vector<Observation> rows;
  for (int k = 0; k < 40; ++k) {
    rows = HexapodObservations(rng, AnyMounts(rng), 14);
    for (Observation& o : rows) {
      std::vector<Observation> one = {o};
      const double factor = std::abs(std::student_t_distribution<double>(1.5)(rng));
      testing::AddNoise(rng, factor * factor * Isotropic(kNoise), &one);
      o = one[0];
    }
    testing::SpoilGrossly(rng, DrawIndices(rng, 5, 14), kNoise, &rows);
  }
  const std::vector<Outlier> outliers = FindOutliers(UnknownNoise(rows), {}, {}).outliers;
  EXPECT_FALSE(outliers.empty());
  for (const Outlier& outlier : outliers) EXPECT_LT(outlier.p_value, 0.01) << outlier.label;
}

TEST(SubsetFit, LevelsOfTheNearestAreThoseOfAll) {
  auto rng = SeededByTest();
  double position = 0.0, orientation = 0.0;
  constexpr int kDraws = 30;
  for (int k = 0; k < kDraws; ++k) {
    const BaseAndTool truth = AnyMounts(rng);
    const Observations clean = UnknownNoise(NoisyRows(rng, truth, 100));
    std::vector<std::pair<double, std::size_t>> distances;
    for (std::size_t i = 0; i < 100; ++i)
      distances.emplace_back(
          (WhitenerOf(Isotropic(kNoise)) *
           PoseError(truth, clean.items[i].base_from_platform, clean.items[i].world_from_tool))
              .norm(),
          i);
    std::sort(distances.begin(), distances.end());
    std::vector<bool> kept(100, false);
    for (std::size_t i = 0; i < 55; ++i) kept[distances[i].second] = true;
    SubsetFit fit(clean, {});
    fit.StartFrom(truth, kNoise);
    fit.Fit(kept, true);
    position += fit.levels().position / kNoise.position / kDraws;
    orientation += fit.levels().orientation / kNoise.orientation / kDraws;
  }
  EXPECT_NEAR(position, 1.0, 0.05);
  EXPECT_NEAR(orientation, 1.0, 0.05);
}

TEST(Outliers, OfDataWithRobotNoise) {
  auto rng = SeededByTest();
  const BaseAndTool truth = AnyMounts(rng);
  std::vector<Observation> rows = HexapodObservations(rng, truth, 30);
  for (Observation& o : rows) {
    o.robot_covariance = Isotropic(kNoise);
    const Matrix6d l = o.robot_covariance.llt().matrixL();
    o.base_from_platform = Plus(o.base_from_platform, Vector6d(l * testing::Normal(rng, 6)));
  }
  testing::AddNoise(rng, Isotropic(kNoise), &rows);
  Spoil(rng, Spoilt::kBoth, 60.0, kNoise, &rows[2]);
  Observations observations = UnknownNoise(rows);
  observations.has_robot_noise = true;
  EXPECT_EQ(Found(observations, 1e-3), std::vector<std::size_t>{2});
}

}  // namespace
}  // namespace hexcal
