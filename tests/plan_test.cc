// SPDX-License-Identifier: BSD-3-Clause
// Planned poses against simulated measurements of them.
#include "discovery/plan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <tuple>

#include "config/input_error.h"
#include "discovery/gap_model.h"
#include "discovery/pose_pool.h"
#include "discovery/score.h"
#include "estimator/calibrate.h"
#include "estimator/calibrate_grown.h"
#include "model/simulate.h"
#include "testing/input_error_text.h"
#include "testing/plan_scene.h"

namespace hexcal {
namespace {

using ::hexcal::testing::AddColumn;
using ::hexcal::testing::Extended;
using ::hexcal::testing::Measured;
using ::hexcal::testing::PoseDataset;
using ::hexcal::testing::SeededByTest;
using ::hexcal::testing::TrueMachine;

Machine Calibrated(const Dataset& dataset) {
  const Estimate estimate = Calibrate(MakeObservations(dataset), std::nullopt, {});
  Machine machine;
  machine.world_from_base = estimate.mounts.world_from_base;
  machine.platform_from_tool = estimate.mounts.platform_from_tool;
  return machine;
}

double LogDeterminantOfCalibration(const Dataset& dataset) {
  const Estimate estimate = Calibrate(MakeObservations(dataset), std::nullopt, {});
  // In mm and mrad.
  return std::log((1e6 * estimate.covariance).determinant());
}

TEST(Plan, DeviationsForetoldAreThoseOfACalibration) {
  auto rng = SeededByTest();
  const Machine truth = TrueMachine(rng);
  const Dataset before = Measured(PoseDataset(rng, 15, true), truth, 1);
  const Plan plan = MakePlan(before, Calibrated(before), {});
  ASSERT_EQ(plan.poses.rows.size(), 12u);
  EXPECT_EQ(plan.goal, PlanGoal::kParameters);
  EXPECT_EQ(plan.measured, 15);
  const Dataset after = Measured(Extended(before, plan.poses), truth, 2);
  const Estimate now = Calibrate(MakeObservations(before), std::nullopt, {});
  const Estimate then = Calibrate(MakeObservations(after), std::nullopt, {});
  for (int k = 0; k < 12; ++k) {
    EXPECT_NEAR(plan.deviation_before[k] / std::sqrt(now.covariance(k, k)), 1.0, 1e-3) << k;
    EXPECT_NEAR(plan.deviation_after[k] / std::sqrt(then.covariance(k, k)), 1.0, 1e-3) << k;
    EXPECT_LT(plan.deviation_after[k], plan.deviation_before[k]) << k;
  }
}

TEST(Plan, DeviationsForetoldOfMarkersAreThoseOfACalibrationByPoses) {
  for (const bool is_static : {false, true}) {
    auto rng = SeededByTest();
    const Machine truth = TrueMachine(rng);
    Dataset before = testing::Plan(rng, is_static);
    before.robot_poses.covariates.clear();
    before.robot_poses.rows.resize(20);
    before = Measured(before, truth, 1);
    PlanOptions options;
    options.poses = 8;
    options.pool = 100;
    const Plan plan = MakePlan(before, Calibrated(before), options);
    const Dataset after = Measured(Extended(before, plan.poses), truth, 2);
    const Estimate then = Calibrate(MakeObservations(after), std::nullopt, {});
    // A static tracker's own error moves the base and is not a pose's.
    const int first = is_static ? 6 : 0;
    for (int k = first; k < 12; ++k)
      EXPECT_NEAR(plan.deviation_after[k] / std::sqrt(then.covariance(k, k)), 1.0, 0.02) << k;
  }
}

TEST(Plan, BeatsRandomPosesFromTheSamePoolOnSeveralMachines) {
  auto rng = SeededByTest();
  for (int machine = 0; machine < 3; ++machine) {
    const Machine truth = TrueMachine(rng);
    Dataset dataset = PoseDataset(rng, 10, machine > 0);
    if (machine == 2) dataset.hexapod->leg_limits.reset();
    const Dataset before = Measured(dataset, truth, 1);
    PlanOptions options;
    options.poses = 6;
    const Plan plan = MakePlan(before, Calibrated(before), options);
    const double planned =
        LogDeterminantOfCalibration(Measured(Extended(before, plan.poses), truth, 2));
    std::vector<Pose3d> reported;
    for (const RobotPose& row : before.robot_poses.rows) reported.push_back(row.base_from_platform);
    const Reach reach = ReachOf(before.hexapod ? &*before.hexapod : nullptr, reported);
    const std::vector<Pose3d> pool = MakePosePool(reach, 300, 1);
    double least = 1e300;
    for (int draw = 0; draw < 20; ++draw) {
      RobotPoses random = plan.poses;
      for (RobotPose& row : random.rows) row.base_from_platform = pool[rng() % pool.size()];
      least = std::min(least,
                       LogDeterminantOfCalibration(Measured(Extended(before, random), truth, 2)));
    }
    EXPECT_LT(planned, least - 0.5) << machine;
  }
}

TEST(Plan, AFirstPlanNeedsNoMeasuredPosesButANoise) {
  auto rng = SeededByTest();
  const Machine machine = TrueMachine(rng);
  Dataset dataset = PoseDataset(rng, 1, true);
  const Plan plan = MakePlan(dataset, machine, {});
  EXPECT_EQ(plan.measured, 0);
  const Dataset after = Measured(Extended(PoseDataset(rng, 0, true), plan.poses), machine, 2);
  const Estimate then = Calibrate(MakeObservations(after), std::nullopt, {});
  for (int k = 0; k < 12; ++k) {
    EXPECT_TRUE(std::isnan(plan.deviation_before[k])) << k;
    EXPECT_NEAR(plan.deviation_after[k] / std::sqrt(then.covariance(k, k)), 1.0, 1e-3) << k;
  }
  dataset.measurement->pose_noise.reset();
  EXPECT_THROW(MakePlan(dataset, machine, {}), InputError);
  PlanOptions options;
  options.noise = NoiseLevels{2e-5, 1e-4};
  const Plan same = MakePlan(dataset, machine, options);
  EXPECT_NEAR(same.deviation_after[0], plan.deviation_after[0], 1e-6 * plan.deviation_after[0]);
}

TEST(Plan, RefusesPosesThatSpanNothing) {
  auto rng = SeededByTest();
  const Machine machine = TrueMachine(rng);
  const Dataset dataset = PoseDataset(rng, 1, false);
  EXPECT_THROW(MakePlan(dataset, machine, {}), InputError);
}

TEST(Plan, EqualSeedsGiveEqualPlansInAnotherOrderThanThePool) {
  auto rng = SeededByTest();
  const Machine truth = TrueMachine(rng);
  const Dataset dataset = Measured(PoseDataset(rng, 12, true), truth, 1);
  PlanOptions options;
  options.poses = 5;
  options.pool = 100;
  const Plan once = MakePlan(dataset, truth, options), again = MakePlan(dataset, truth, options);
  options.seed = 2;
  const Plan other = MakePlan(dataset, truth, options);
  int different = 0;
  for (int k = 0; k < 5; ++k) {
    EXPECT_EQ(once.base_from_platform[k].translation, again.base_from_platform[k].translation);
    if (once.base_from_platform[k].translation != other.base_from_platform[k].translation)
      ++different;
  }
  EXPECT_GT(different, 0);
}

TEST(Plan, LabelsAreNewAndCovariatesAreOnesThatWereSet) {
  auto rng = SeededByTest();
  const Machine truth = TrueMachine(rng);
  Dataset dataset = PoseDataset(rng, 12, true);
  dataset.robot_poses.rows[3].label = "plan-1";
  AddColumn("payload", {0.0, 5.0}, &dataset);
  std::vector<double> times;
  for (int i = 0; i < 12; ++i) times.push_back(100.0 + 30.0 * i);
  AddColumn("time", times, &dataset);
  const Plan plan = MakePlan(Measured(dataset, truth, 1), truth, {});
  std::set<std::string> labels;
  std::set<double> loads;
  for (std::size_t k = 0; k < plan.poses.rows.size(); ++k) {
    labels.insert(plan.poses.rows[k].label);
    loads.insert(plan.poses.covariates[0].values[k]);
    EXPECT_DOUBLE_EQ(plan.poses.covariates[1].values[k], 430.0 + 30.0 * static_cast<double>(k + 1));
  }
  EXPECT_EQ(labels.size(), 12u);
  EXPECT_EQ(labels.count("plan-1"), 0u);
  EXPECT_EQ(loads, (std::set<double>{0.0, 5.0}));
}

}  // namespace
}  // namespace hexcal
