// SPDX-License-Identifier: BSD-3-Clause
// The generator of hidden effects against itself. hidden_effects_test.cc holds it against hexcal's
// model.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "hidden/hidden_case.h"
#include "hidden/pose_fit.h"
#include "hidden/write_case.h"

namespace hexcal::hidden {
namespace {

SceneOptions Short(int measured) {
  SceneOptions options;
  options.measured = measured;
  options.visited_only = 8;
  return options;
}

Motion AnyMotion(Dice* dice) {
  return {TurnBy(Eigen::Vector3d(dice->Normals(3))), Eigen::Vector3d(dice->Normals(3))};
}

TEST(Motions, ComposeInvertAndMoveBack) {
  Dice dice(1, 0);
  for (int k = 0; k < 50; ++k) {
    const Motion a = AnyMotion(&dice), b = AnyMotion(&dice);
    const Eigen::Vector3d x = dice.Normals(3);
    EXPECT_LT((a * b * x - a * (b * x)).norm(), 1e-13);
    EXPECT_LT((Inverse(a) * (a * x) - x).norm(), 1e-13);
    EXPECT_NEAR(a.turn.determinant(), 1.0, 1e-13);
    const Motion again = Moved(a, TwistBetween(a, b));
    EXPECT_LT((again.turn - b.turn).norm() + (again.shift - b.shift).norm(), 1e-12);
  }
  // A quarter turn about z takes x to y.
  EXPECT_LT((TurnBy({0, 0, M_PI / 2}) * Eigen::Vector3d::UnitX() - Eigen::Vector3d::UnitY()).norm(),
            1e-15);
}

TEST(Legs, CloseTheirLoopsAgain) {
  for (int k = 0; k < 20; ++k) {
    Dice dice(2, k);
    const Scene scene = DrawScene(Short(5), &dice);
    for (const Row& row : scene.rows) {
      Motion pose = scene.home;
      ASSERT_TRUE(CloseLoop(scene.hexapod.base, scene.hexapod.platform, row.lengths, &pose));
      EXPECT_LT(TwistBetween(row.base_from_platform, pose).norm(), 1e-11);
    }
  }
}

TEST(Legs, CarryTheLoad) {
  // Six upright legs share a load over the centre of the platform: each is pressed by a sixth.
  Hexapod hexapod;
  for (int i = 0; i < 6; ++i)
    hexapod.base.col(i) << std::cos(i * M_PI / 3), std::sin(i * M_PI / 3), 0;
  hexapod.platform = hexapod.base;
  // Upright legs alone would not resist a turn: lean them in turn.
  for (int i = 0; i < 6; ++i) {
    const double lean = i % 2 == 0 ? 0.3 : -0.3;
    hexapod.platform.col(i) << std::cos(i * M_PI / 3 + lean), std::sin(i * M_PI / 3 + lean), 0;
  }
  const Motion pose{Eigen::Matrix3d::Identity(), {0, 0, 1}};
  const Six force =
      LegForces(hexapod, pose, 6.0, Eigen::Vector3d::Zero(), -Eigen::Vector3d::UnitZ());
  const double upright = LegDirections(hexapod.base, hexapod.platform, pose)(2, 0);
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(force[i], -9.80665 / upright, 1e-12);
}

// Readings without noise leave nothing but the effect, and a fit with the effect leaves nothing.
TEST(Snr, IsWhatTheBestCalibrationLeaves) {
  for (const char* kind : {"leg_thermal", "tool_step", "marker_shift", "tracker_scale"}) {
    CaseOptions options;
    options.kind = kind;
    options.snr = 10.0;
    options.scene = Short(30);
    const Case made = MakeCase(options, 3, 0);
    const auto readings = TrueReadings(made.scene, made.effects);
    EXPECT_NEAR(std::sqrt(FitMounts(made.scene, {}, readings).chi_square), 10.0, 0.1) << kind;
    EXPECT_LT(FitMounts(made.scene, made.effects, readings).chi_square, 0.5) << kind;
  }
}

// The mean chi-square over repeats is that of noise alone plus the SNR's square.
TEST(Snr, IsTheNoncentralityOfRepeats) {
  CaseOptions options;
  options.kind = "base_drift";
  options.snr = 12.0;
  options.scene = Short(20);
  const Case made = MakeCase(options, 4, 0);
  Dice dice(4, 1);
  double sum = 0.0;
  constexpr int kRepeats = 60;
  for (int k = 0; k < kRepeats; ++k)
    sum += FitMounts(made.scene, {}, NoisyReadings(made.scene, made.effects, Regime::kWhite, &dice))
               .chi_square;
  const double degrees = 18.0 * 20 - 12, expected = degrees + 144.0;
  const double sigma = std::sqrt((2 * degrees + 4 * 144.0) / kRepeats);
  EXPECT_NEAR(sum / kRepeats, expected, 4 * sigma);
}

// Whitened noise of all readings of some rows and some scenes.
struct Moments {
  double square = 0.0, fourth = 0.0;
  std::vector<double> row_squares;  // mean a row
  double successive = 0.0;          // mean product of one coordinate in successive rows
};

Moments MomentsOf(Regime regime, bool by_stated_sigma) {
  Moments moments;
  int count = 0, pairs = 0;
  for (int k = 0; k < 15; ++k) {
    Dice dice(5, k);
    const Scene scene = DrawScene(Short(60), &dice);
    const auto noisy = NoisyReadings(scene, {}, regime, &dice);
    const auto clean = TrueReadings(scene, {});
    Reading before = Reading::Zero();
    std::size_t next = 0;
    for (const Row& row : scene.rows) {
      if (!row.is_measured) continue;
      Reading x = noisy[next] - clean[next];
      x = by_stated_sigma ? Reading(x.cwiseQuotient(scene.sigma.replicate(8, 1)))
                          : Reading(NoiseCovariance(scene, row, regime).llt().matrixL().solve(x));
      moments.square += x.squaredNorm();
      moments.fourth += x.array().pow(4).sum();
      moments.row_squares.push_back(x.squaredNorm() / 24);
      if (next++ > 0) {
        moments.successive += x.dot(before);
        pairs += 24;
      }
      before = x;
      count += 24;
    }
  }
  moments.square /= count;
  moments.fourth /= count;
  moments.successive /= pairs;
  return moments;
}

TEST(Noise, WhiteIsAsStated) {
  const Moments moments = MomentsOf(Regime::kWhite, true);
  EXPECT_NEAR(moments.square, 1.0, 0.04);
  EXPECT_NEAR(moments.fourth, 3.0, 0.3);
  EXPECT_NEAR(moments.successive, 0.0, 0.03);
}

TEST(Noise, HeavyTailsKeepTheVariance) {
  const Moments moments = MomentsOf(Regime::kHeavyTails, true);
  EXPECT_NEAR(moments.square, 1.0, 0.06);
  EXPECT_GT(moments.fourth, 5.0);
}

TEST(Noise, OnePoseInTwentyIsAnOutlier) {
  const Moments moments = MomentsOf(Regime::kOutliers, true);
  const double share = std::count_if(moments.row_squares.begin(),
                                     moments.row_squares.end(),
                                     [](double square) { return square > 2.0; }) /
                       static_cast<double>(moments.row_squares.size());
  EXPECT_NEAR(share, 0.05, 0.025);
}

TEST(Noise, UnderstatedSigmaIsTwentyPercentTooSmall) {
  EXPECT_NEAR(MomentsOf(Regime::kUnderstated, true).square, std::pow(1 / 0.8, 2), 0.05);
  EXPECT_NEAR(MomentsOf(Regime::kUnderstated, false).square, 1.0, 0.04);
}

TEST(Noise, ScaleVariesFromPoseToPose) {
  const Moments moments = MomentsOf(Regime::kVaryingScale, true);
  EXPECT_NEAR(moments.square, 1.0, 0.12);
  std::vector<double> logs;
  double mean = 0.0, square = 0.0;
  for (const double s : moments.row_squares) {
    logs.push_back(0.5 * std::log(s));
    mean += logs.back() / moments.row_squares.size();
  }
  for (const double l : logs) square += (l - mean) * (l - mean) / logs.size();
  // 24 draws a row blur the logarithm of their root mean square by 1/sqrt(48).
  EXPECT_NEAR(std::sqrt(square), std::sqrt(0.16 + 1.0 / 48), 0.03);
}

TEST(Noise, GrowsThreefoldWithTheRange) {
  const Moments moments = MomentsOf(Regime::kRangeDependent, true);
  EXPECT_NEAR(moments.square, 1.0, 0.04);
  const auto [least, most] =
      std::minmax_element(moments.row_squares.begin(), moments.row_squares.end());
  EXPECT_GT(std::sqrt(*most / *least), 2.0);
  EXPECT_NEAR(MomentsOf(Regime::kRangeDependent, false).square, 1.0, 0.04);
}

TEST(Noise, ARobotMissesItsPoses) {
  // By the covariance that is told, and by it alone, the rows are white.
  EXPECT_NEAR(MomentsOf(Regime::kHalfRepeat, false).square, 1.0, 0.04);
  EXPECT_NEAR(MomentsOf(Regime::kFullRepeat, false).square, 1.0, 0.04);
  EXPECT_GT(MomentsOf(Regime::kFullRepeat, true).square, 1.15);
}

// Of the six numbers of a pose, seen through the tracker, a robot of one sigma doubles the
// variance.
TEST(Noise, TheRobotsShareIsThatOfTheSeenPose) {
  for (const auto& [regime, share] :
       {std::pair(Regime::kHalfRepeat, 0.25), std::pair(Regime::kFullRepeat, 1.0)}) {
    double sum = 0.0;
    constexpr int kRepeats = 40;
    for (int k = 0; k < kRepeats; ++k) {
      Dice dice(6, k);
      const Scene scene = DrawScene(Short(20), &dice);
      sum += FitMounts(scene, {}, NoisyReadings(scene, {}, regime, &dice)).pose_chi_square;
    }
    const double degrees = 6.0 * 20 - 12;
    EXPECT_NEAR(
        sum / kRepeats / degrees, 1.0 + share, 5 * (1 + share) * std::sqrt(2 / degrees / kRepeats));
  }
}

TEST(Noise, IsCorrelatedFromPoseToPose) {
  const Moments moments = MomentsOf(Regime::kSerial, true);
  EXPECT_NEAR(moments.square, 1.0, 0.08);
  EXPECT_NEAR(moments.successive / moments.square, 0.8, 0.03);
}

TEST(Cases, AreTheSameForTheSameSeed) {
  CaseOptions options;
  options.kind = "pair";
  options.scene = Short(20);
  const auto a = CaseFiles(MakeCase(options, 7, 3), options);
  EXPECT_EQ(a, CaseFiles(MakeCase(options, 7, 3), options));
  EXPECT_NE(a, CaseFiles(MakeCase(options, 7, 4), options));
}

TEST(Cases, HideEveryEffectAtItsClearness) {
  CaseOptions options;
  options.scene = Short(40);
  for (const auto* table : {&ListedEffects(), &UnlistedEffects()})
    for (const EffectRow& row : *table) {
      options.kind = row.name;
      const Case made = MakeCase(options, 8, 0);
      ASSERT_EQ(made.effects.size(), 1u) << row.name;
      EXPECT_NEAR(Snr(made.scene, made.effects, {}, Regime::kWhite), 12.0, 0.05) << row.name;
      EXPECT_EQ(made.readings.size(), 40u);
    }
}

}  // namespace
}  // namespace hexcal::hidden
