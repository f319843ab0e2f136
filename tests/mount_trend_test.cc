// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/mount_trend.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "estimator/quantiles.h"
#include "testing/random.h"

namespace hexcal {
namespace {

using ::hexcal::testing::Normal;
using ::hexcal::testing::RandomPose;
using ::hexcal::testing::SeededByTest;

constexpr double kDay = 86400.0;
constexpr double kSigma = 1e-4;

// x of base by so much and everything else in place; the same sigma for all 12.
DatedMounts At(double day, double base_dx, double sigma = kSigma) {
  DatedMounts record;
  record.time = day * kDay;
  record.known.mounts.world_from_base.translation.x() = base_dx;
  record.known.covariance = sigma * sigma * Matrix12d::Identity();
  record.known.determined.fill(true);
  return record;
}

TEST(MountChange, IsTheMotionOnTheRightInItsOwnDeviations) {
  auto rng = SeededByTest();
  KnownMounts earlier, now;
  earlier.mounts = {RandomPose(rng, 1.0), RandomPose(rng, 1.0)};
  Vector6d base, tool;
  base << 1e-3, -2e-3, 3e-3, 4e-3, -5e-3, 6e-3;
  tool << -7e-3, 8e-3, 9e-3, 1e-3, 2e-3, -3e-3;
  now.mounts = {Plus(earlier.mounts.world_from_base, base),
                Plus(earlier.mounts.platform_from_tool, tool)};
  earlier.determined.fill(true);
  now.determined.fill(true);
  earlier.covariance.diagonal().setConstant(9e-6);
  now.covariance.diagonal().setConstant(16e-6);
  MountChange change = ChangeBetween(earlier, now);
  Vector12d expected;
  expected << base, tool;
  EXPECT_LT((change.difference - expected).norm(), 1e-12);
  EXPECT_LT((change.sigmas - expected / 5e-3).norm(), 1e-8);
  EXPECT_NEAR(change.chi_square, expected.squaredNorm() / 25e-6, 1e-6);
  EXPECT_NEAR(change.p_value, ChiSquareTail(change.chi_square, 12.0), 1e-12);
  now.determined[3] = false;
  change = ChangeBetween(earlier, now);
  EXPECT_TRUE(std::isnan(change.sigmas[3]));
  EXPECT_FALSE(std::isnan(change.sigmas[4]));
  EXPECT_TRUE(std::isnan(change.p_value));
}

// By hand. Two records: 0 and 3 sigma. The second against the first: variance 2 sigma^2.
// Third at 1.5 sigma: against their mean, 1.5 sigma, variance (1 + 1/2) sigma^2.
TEST(MountTrend, JudgesByThoseBefore) {
  const MountTrend trend = TrendOf({At(0, 0), At(1, 3 * kSigma), At(2, 4.5 * kSigma)});
  ASSERT_EQ(trend.points.size(), 3u);
  EXPECT_FALSE(trend.points[0].is_judged);
  const TrendPoint& second = trend.points[1];
  EXPECT_TRUE(second.is_judged);
  EXPECT_NEAR(second.level.t_squared, 9.0 / 2.0, 1e-9);
  EXPECT_NEAR(second.level.t_squared_limit, ChiSquareQuantile(1 - 0.0027, 12), 1e-9);
  EXPECT_NEAR(second.level.deviation[0], 3 * kSigma, 1e-15);
  // Normal quantile at 1 - 0.0027 / 24: 3.68916.
  EXPECT_NEAR(second.level.half_width[0], 3.68916 * std::sqrt(2.0) * kSigma, 1e-5 * kSigma);
  EXPECT_TRUE(second.is_in_control);
  ASSERT_TRUE(second.step);
  EXPECT_NEAR(second.step->sigmas[0], 3.0 / std::sqrt(2.0), 1e-9);
  const TrendPoint& third = trend.points[2];
  EXPECT_NEAR(third.level.deviation[0], 3 * kSigma, 1e-12);
  EXPECT_NEAR(third.level.t_squared, 9.0 / 1.5, 1e-9);
  EXPECT_NEAR(third.level.half_width[0], 3.68916 * std::sqrt(1.5) * kSigma, 1e-4 * kSigma);
  EXPECT_NEAR(third.step->difference[0], 1.5 * kSigma, 1e-12);
}

// Weights are those of the covariances: 0 with sigma and 3 sigma with 2 sigma have the mean 0.6.
TEST(MountTrend, WeighsByCovariance) {
  const MountTrend trend =
      TrendOf({At(0, 0), At(1, 3 * kSigma, 2 * kSigma), At(2, 0.6 * kSigma, 1e-2 * kSigma)});
  EXPECT_NEAR(trend.points[2].level.deviation[0], 0.0, 1e-12);
  EXPECT_NEAR(trend.points[2].level.t_squared, 0.0, 1e-9);
}

TEST(MountTrend, ARecordOutOfControlDoesNotCountForTheLater) {
  const MountTrend trend =
      TrendOf({At(0, 0), At(1, 20 * kSigma), At(2, 0), At(3, 20 * kSigma), At(4, 0)});
  EXPECT_EQ(trend.in_control, 3);
  for (const int i : {1, 3}) {
    EXPECT_FALSE(trend.points[i].is_in_control);
    EXPECT_TRUE(trend.points[i].level.outside[0]);
    for (int k = 1; k < 12; ++k) EXPECT_FALSE(trend.points[i].level.outside[k]);
  }
  EXPECT_TRUE(trend.points[2].is_in_control);
  EXPECT_NEAR(trend.points[4].level.deviation[0], 0.0, 1e-15);
  EXPECT_FALSE(trend.scatter_shows);
}

// A baseline of four at +-10 sigma scatters. By hand: weights 1/sigma^2, Q = 400, so
// tau^2 = (400 - 3) / (4 - 1) sigma^2; the other 11 have none.
TEST(MountTrend, ScatterOfTheBaselineWidensTheLimits) {
  const std::vector<DatedMounts> records = {At(0, -10 * kSigma),
                                            At(1, 10 * kSigma),
                                            At(2, -10 * kSigma),
                                            At(3, 10 * kSigma),
                                            At(4, 20 * kSigma)};
  TrendOptions options;
  options.baseline = 4;
  const MountTrend trend = TrendOf(records, options);
  EXPECT_FALSE(trend.points[3].is_judged);
  const TrendPoint& last = trend.points[4];
  const double between = 397.0 / 3.0;
  EXPECT_NEAR(last.level.deviation[0], 20 * kSigma, 1e-9);
  const double quantile = StudentTQuantile(1 - 0.0027 / 24, 3);
  EXPECT_NEAR(last.level.half_width[0],
              quantile * std::sqrt(1 + between + (1 + between) / 4) * kSigma,
              1e-6 * kSigma);
  EXPECT_NEAR(last.level.half_width[1], quantile * std::sqrt(1.25) * kSigma, 1e-6 * kSigma);
  EXPECT_NEAR(last.level.t_squared, 400.0 / (1.25 * (1 + between)), 1e-6);
  EXPECT_NEAR(last.level.t_squared_limit, 12 * FisherFQuantile(1 - 0.0027, 12, 3), 1e-6);
  EXPECT_TRUE(last.is_in_control);
  EXPECT_TRUE(trend.scatter_shows);
  // Without the baseline the first jump is out of control.
  EXPECT_FALSE(TrendOf(records).points[1].is_in_control);
}

// By hand: 0, then a, then b. The moving mean is 0.2 a, then 0.16 a + 0.2 b; the variance of the
// latter from the first record 0.16^2 + 0.2^2 + 0.36^2 of sigma^2.
TEST(MountTrend, TheMovingMeanIsJudgedFromTheBaseline) {
  const MountTrend trend = TrendOf({At(0, 0), At(1, 2 * kSigma), At(2, 3 * kSigma)});
  const double z = 3.68916;
  EXPECT_NEAR(trend.points[1].moving.deviation[0], 0.4 * kSigma, 1e-12);
  EXPECT_NEAR(trend.points[1].moving.t_squared, 0.16 / 0.08, 1e-9);
  const ChartTest& moving = trend.points[2].moving;
  const double variance = 0.16 * 0.16 + 0.2 * 0.2 + 0.36 * 0.36;
  EXPECT_NEAR(moving.deviation[0], 0.92 * kSigma, 1e-12);
  EXPECT_NEAR(moving.half_width[0], z * std::sqrt(variance) * kSigma, 1e-5 * kSigma);
  EXPECT_NEAR(moving.t_squared, 0.92 * 0.92 / variance, 1e-9);
  EXPECT_NEAR(moving.t_squared_limit, ChiSquareQuantile(1 - 0.0027, 12), 1e-9);
  EXPECT_TRUE(moving.is_in_control);
}

// Exactly on a line: 2 sigma a day. By hand for times 0, 1, 2: slope's sigma is sigma / sqrt(2).
TEST(MountTrend, DriftOfALineIsItsSlope) {
  const MountTrend trend = TrendOf({At(0, 0), At(1, 2 * kSigma), At(2, 4 * kSigma)});
  ASSERT_TRUE(trend.drift);
  EXPECT_NEAR(trend.drift->rate[0] * kDay, 2 * kSigma, 1e-12);
  EXPECT_NEAR(trend.drift->rate[5] * kDay, 0.0, 1e-12);
  EXPECT_NEAR(trend.drift->standard_deviation[0] * kDay, kSigma / std::sqrt(2.0), 1e-12);
  EXPECT_FALSE(trend.drift->scatter_shows);
  EXPECT_NEAR(trend.drift->statistic, 8.0, 1e-8);
  EXPECT_NEAR(trend.drift->p_value, ChiSquareTail(8.0, 12.0), 1e-9);
  EXPECT_FALSE(TrendOf({At(0, 0), At(1, 0)}).drift);
  EXPECT_FALSE(TrendOf({At(1, 0), At(1, 1e-4), At(1, 2e-4)}).drift);
}

// Far off a flat line by turns, +-10 sigma: that is scatter, no drift. By hand for four records a
// day apart: the slope is 4 sigma a day, the deviations' sum of squares 400 - 16 * 5 = 320 sigma^2,
// so tau^2 = 320 / 2 - 1, and the slope's variance 160 / 5 sigma^2.
TEST(MountTrend, ScatterAboutTheLineIsNoDrift) {
  const MountTrend trend =
      TrendOf({At(0, -10 * kSigma), At(1, 10 * kSigma), At(2, -10 * kSigma), At(3, 10 * kSigma)});
  EXPECT_TRUE(trend.drift->scatter_shows);
  EXPECT_NEAR(trend.drift->rate[0] * kDay, 4 * kSigma, 1e-12);
  EXPECT_NEAR(trend.drift->standard_deviation[0] * kDay, std::sqrt(160.0 / 5.0) * kSigma, 1e-12);
  EXPECT_NEAR(trend.drift->statistic, 16.0 * 5.0 / 160.0, 1e-9);
  EXPECT_NEAR(trend.drift->p_value, FisherFTail(0.5 / 12.0, 12.0, 2.0), 1e-9);
}

TEST(MountTrend, LeavesOutWhatCannotBeTrusted) {
  std::vector<DatedMounts> records = {At(0, 0), At(1, 1.0), At(2, 2.0), At(3, 3.0), At(4, 0)};
  records[1].is_trusted = false;
  records[2].known.determined[7] = false;
  records[3].known.covariance(2, 2) = 0.0;
  const MountTrend trend = TrendOf(records);
  for (const int i : {1, 2, 3}) EXPECT_FALSE(trend.points[i].is_used) << i;
  EXPECT_TRUE(trend.points[4].is_judged);
  EXPECT_TRUE(trend.points[4].is_in_control);
  EXPECT_EQ(trend.in_control, 2);
  EXPECT_TRUE(TrendOf({}).points.empty());
}

DatedMounts Draw(std::mt19937_64& rng,
                 const KnownMounts& truth,
                 const Matrix12d& factor,
                 double day) {
  const Vector12d noise = factor * Normal(rng, 12);
  DatedMounts record;
  record.time = day * kDay;
  record.known = truth;
  record.known.mounts.world_from_base = Plus(truth.mounts.world_from_base, Vector6d(noise.head(6)));
  record.known.mounts.platform_from_tool =
      Plus(truth.mounts.platform_from_tool, Vector6d(noise.tail(6)));
  return record;
}

// Correlated and unequal, of a calibration's size.
Matrix12d AnyFactor(std::mt19937_64& rng) {
  Matrix12d factor = Matrix12d::Zero();
  for (int i = 0; i < 12; ++i) {
    factor.row(i).head(i + 1) = 3e-5 * Normal(rng, i + 1).transpose();
    factor(i, i) = (i % 6 < 3 ? 4e-5 : 2e-4) * (1 + 0.1 * i);
  }
  return factor;
}

// 300 steady machines of ten records. Each record has four chances of 0.27 % to be called out of
// control, two of level and two of the moving mean: 29 of 2700 on the average if they never met, 46
// at most with 99.9 %.
TEST(MountTrend, SteadyMachinesAreInControl) {
  auto rng = SeededByTest();
  const Matrix12d factor = AnyFactor(rng);
  KnownMounts truth;
  truth.mounts = {RandomPose(rng, 1.0), RandomPose(rng, 0.3)};
  truth.covariance = factor * factor.transpose();
  truth.determined.fill(true);
  int out = 0, drifting = 0;
  double sum_p = 0.0;
  constexpr int kMachines = 300, kRecords = 10;
  for (int machine = 0; machine < kMachines; ++machine) {
    std::vector<DatedMounts> records;
    for (int k = 0; k < kRecords; ++k) records.push_back(Draw(rng, truth, factor, k));
    const MountTrend trend = TrendOf(records);
    for (int k = 1; k < kRecords; ++k) {
      sum_p += trend.points[k].level.p_value;
      if (!trend.points[k].is_in_control) ++out;
    }
    if (trend.drift->p_value < 0.01) ++drifting;
  }
  EXPECT_LE(out, 46);
  EXPECT_GE(out, 2);
  EXPECT_LE(drifting, 11);
  EXPECT_NEAR(sum_p / (kMachines * (kRecords - 1)), 0.5, 0.03);
}

// One of the parameters drifts by half its sigma a record: the drift is found, its rate within
// its uncertainty, and in the end the records are out of control, in that parameter.
TEST(MountTrend, FindsADriftAndItsParameter) {
  auto rng = SeededByTest();
  const Matrix12d factor = AnyFactor(rng);
  KnownMounts truth;
  truth.mounts = {RandomPose(rng, 1.0), RandomPose(rng, 0.3)};
  truth.covariance = factor * factor.transpose();
  truth.determined.fill(true);
  constexpr int kDrifting = 2;  // base.dz
  const double per_record = 0.5 * std::sqrt(truth.covariance(kDrifting, kDrifting));
  std::vector<DatedMounts> records;
  KnownMounts now = truth;
  for (int k = 0; k < 20; ++k) {
    Vector6d moved = Vector6d::Zero();
    moved[kDrifting] = per_record * k;
    now.mounts.world_from_base = Plus(truth.mounts.world_from_base, moved);
    records.push_back(Draw(rng, now, factor, k));
  }
  const MountTrend trend = TrendOf(records);
  EXPECT_LT(trend.drift->p_value, 1e-6);
  EXPECT_NEAR(trend.drift->rate[kDrifting] * kDay,
              per_record,
              3 * trend.drift->standard_deviation[kDrifting] * kDay);
  for (int k = 15; k < 20; ++k) {
    EXPECT_FALSE(trend.points[k].is_in_control) << k;
    EXPECT_TRUE(trend.points[k].moving.outside[kDrifting] ||
                trend.points[k].level.outside[kDrifting])
        << k;
  }
  for (int k = 1; k < 5; ++k) EXPECT_TRUE(trend.points[k].is_in_control) << k;
}

// A remounted tool: everything from then on is out of control until a new chart begins.
TEST(MountTrend, AJumpStaysOutOfControlUntilANewChart) {
  auto rng = SeededByTest();
  const Matrix12d factor = AnyFactor(rng);
  KnownMounts truth;
  truth.covariance = factor * factor.transpose();
  truth.determined.fill(true);
  KnownMounts moved = truth;
  moved.mounts.platform_from_tool.translation.y() += 2e-3;
  std::vector<DatedMounts> records;
  for (int k = 0; k < 8; ++k) records.push_back(Draw(rng, k < 4 ? truth : moved, factor, k));
  const MountTrend trend = TrendOf(records);
  for (int k = 1; k < 8; ++k) EXPECT_EQ(trend.points[k].is_in_control, k < 4) << k;
  EXPECT_TRUE(trend.points[4].level.outside[7]);
  const MountTrend anew = TrendOf({records.begin() + 4, records.end()});
  for (int k = 1; k < 4; ++k) EXPECT_TRUE(anew.points[k].is_in_control) << k;
}

}  // namespace
}  // namespace hexcal
