// SPDX-License-Identifier: BSD-3-Clause
// Poses planned to tell rival effects apart, against simulated measurements of them.
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
using ::hexcal::testing::Uniform;

// An effect of all legs or of none, of a size of the table's plausible one.
Machine WithEffect(Machine machine, const std::string& name, double sizes, const Dataset& dataset) {
  const EffectKind& kind = *FindEffectKind(name);
  std::vector<Pose3d> reported;
  for (const RobotPose& row : dataset.robot_poses.rows) reported.push_back(row.base_from_platform);
  Effect effect;
  effect.name = name;
  effect.parameters.setZero(kind.SizeFor({}));
  for (int k = 0; k < effect.parameters.size(); ++k)
    if (!kind.ParameterOf(k).is_search) effect.parameters[k] = sizes * kind.ScaleOf(k);
  effect.reference = ReferenceFor(
      kind, MakeVisits(dataset, dataset.hexapod ? &*dataset.hexapod : nullptr, reported), dataset);
  machine.effects = {effect};
  return machine;
}

const RivalPair* PairOf(const Plan& plan, const std::string& rival) {
  for (const RivalPair& pair : plan.pairs)
    if (pair.rival == rival) return &pair;
  return nullptr;
}

// How often, in repeated measurements, the rival explains more than the effect that is there; both
// of one number.
double Mistaken(const Dataset& dataset,
                const Machine& truth,
                const std::string& effect,
                const std::string& rival) {
  constexpr int kDraws = 120;
  std::vector<Pose3d> reported;
  for (const RobotPose& row : dataset.robot_poses.rows) reported.push_back(row.base_from_platform);
  int mistaken = 0;
  for (int draw = 0; draw < kDraws; ++draw) {
    const Dataset measured = Measured(dataset, truth, 100 + draw);
    const GapData data = MakeGapData(measured, reported);
    FormLibrary two;
    two.families = {{effect}, {rival}};
    for (int family = 0; family < 2; ++family) {
      FormDefinition form;
      form.family = family;
      form.effect = WithEffect(truth, two.families[family].name, 0.0, measured).effects[0];
      form.directions = Eigen::MatrixXd::Ones(form.effect.parameters.size(), 1);
      form.scale = Eigen::VectorXd::Ones(1);
      two.forms.push_back(form);
    }
    const GapProblem problem =
        MakeGapProblem(data, {truth.world_from_base, truth.platform_from_tool}, {}, two);
    GapNoise stated;
    stated.factor = {1.0, 0.0, 0.0};
    stated.weight = Eigen::VectorXd::Ones(problem.linear.poses);
    stated.shape_weight = stated.weight;
    const Scorer scorer(problem.linear, stated);
    if (scorer.scores()[1].gain > scorer.scores()[0].gain) ++mistaken;
  }
  return static_cast<double>(mistaken) / kDraws;
}

double ChanceOfMistake(double distance) { return 0.5 * std::erfc(0.5 * distance / std::sqrt(2.0)); }

TEST(Plan, RivalsAreMistakenAsOftenAsForetoldAndLessThanWithRandomPoses) {
  auto rng = SeededByTest();
  Dataset dataset = PoseDataset(rng, 40, true);
  for (RobotPose& row : dataset.robot_poses.rows)
    row.base_from_platform.translation.z() =
        testing::kLargeHeight +
        0.5 * (row.base_from_platform.translation.z() - testing::kLargeHeight);
  const Machine truth = WithEffect(TrueMachine(rng), "leg_offset", 0.5, dataset);
  const Dataset before = Measured(dataset, truth, 1);
  PlanOptions options;
  options.goal = PlanGoal::kRivals;
  options.poses = 6;
  const Plan plan = MakePlan(before, truth, options);
  const RivalPair* pair = PairOf(plan, "base_radius");
  ASSERT_NE(pair, nullptr);
  EXPECT_GT(pair->after, pair->before + 1.0);

  const double now = Mistaken(before, truth, "leg_offset", "base_radius");
  const double then = Mistaken(Extended(before, plan.poses), truth, "leg_offset", "base_radius");
  const auto band = [](double p) { return 4.0 * std::sqrt(std::max(p, 0.01) * (1.0 - p) / 120.0); };
  EXPECT_NEAR(now, ChanceOfMistake(pair->before), band(ChanceOfMistake(pair->before)));
  EXPECT_NEAR(then, ChanceOfMistake(pair->after), band(ChanceOfMistake(pair->after)));

  std::vector<Pose3d> reported;
  for (const RobotPose& row : before.robot_poses.rows) reported.push_back(row.base_from_platform);
  const std::vector<Pose3d> pool = MakePosePool(ReachOf(&*before.hexapod, reported), 300, 1);
  RobotPoses random = plan.poses;
  for (RobotPose& row : random.rows) row.base_from_platform = pool[rng() % pool.size()];
  EXPECT_GT(Mistaken(Extended(before, random), truth, "leg_offset", "base_radius"), then + 0.05);
}

TEST(Plan, DeviationsForetoldWithEffectsAreThoseOfAJointCalibration) {
  auto rng = SeededByTest();
  Dataset dataset = PoseDataset(rng, 20, true);
  const Machine truth = WithEffect(TrueMachine(rng), "leg_gain", 2.0, dataset);
  const Dataset before = Measured(dataset, truth, 1);
  PlanOptions options;
  options.goal = PlanGoal::kParameters;
  options.pool = 150;
  const Plan plan = MakePlan(before, CalibrateGrown(before, truth, {}).machine, options);
  const Dataset after = Measured(Extended(before, plan.poses), truth, 2);
  const Estimate now = CalibrateGrown(before, truth, {}).estimate;
  const Estimate then = CalibrateGrown(after, truth, {}).estimate;
  const Estimate without = Calibrate(MakeObservations(after), std::nullopt, {});
  for (int k = 0; k < 12; ++k) {
    EXPECT_NEAR(plan.deviation_before[k] / std::sqrt(now.covariance(k, k)), 1.0, 0.01) << k;
    EXPECT_NEAR(plan.deviation_after[k] / std::sqrt(then.covariance(k, k)), 1.0, 0.01) << k;
  }
  // What the gains cost.
  EXPECT_GT(then.covariance.trace(), 1.05 * without.covariance.trace());
}

// Two laws of the tracker, which markers tell and poses hardly do.
TEST(Plan, RivalsThatShowInTheMarkersAreMistakenAsOftenAsForetold) {
  auto rng = SeededByTest();
  Dataset dataset = testing::Plan(rng, false);
  dataset.robot_poses.covariates.clear();
  dataset.robot_poses.rows.resize(30);
  const Machine truth = WithEffect(TrueMachine(rng), "tracker_scale", 0.05, dataset);
  const Dataset before = Measured(dataset, truth, 1);
  PlanOptions options;
  options.goal = PlanGoal::kRivals;
  options.poses = 5;
  options.pool = 100;
  const Plan plan = MakePlan(before, truth, options);
  const RivalPair* pair = PairOf(plan, "tracker_depth_scale");
  ASSERT_NE(pair, nullptr);
  for (const auto& [poses, distance] :
       {std::pair(before, pair->before), std::pair(Extended(before, plan.poses), pair->after)}) {
    const double chance = ChanceOfMistake(distance);
    EXPECT_NEAR(Mistaken(poses, truth, "tracker_scale", "tracker_depth_scale"),
                chance,
                4.0 * std::sqrt(std::max(chance, 0.01) * (1.0 - chance) / 120.0))
        << distance;
  }
}

TEST(Plan, ATemperatureThatWentUpWithTimeIsPlannedUpAndDown) {
  auto rng = SeededByTest();
  Dataset dataset = PoseDataset(rng, 40, true);
  std::vector<double> times, temperatures;
  for (int i = 0; i < 40; ++i) {
    times.push_back(60.0 * i);
    temperatures.push_back(20.0 + 0.1 * i + Uniform(rng, -0.2, 0.2));
  }
  AddColumn("time", times, &dataset);
  AddColumn("temperature", temperatures, &dataset);
  const Machine truth = WithEffect(TrueMachine(rng), "leg_thermal", 2.0, dataset);
  const Dataset before = Measured(dataset, truth, 1);
  const Plan plan = MakePlan(before, truth, {});
  EXPECT_EQ(plan.goal, PlanGoal::kRivals);
  const RivalPair* pair = PairOf(plan, "base_drift");
  ASSERT_NE(pair, nullptr);
  EXPECT_LT(pair->before * pair->before, 10.8);
  EXPECT_GT(pair->after * pair->after, 10.8);
  EXPECT_EQ(pair->separation, Separation::kByPlan);
  // Not in the order of time.
  const std::vector<double>& planned = plan.poses.covariates[1].values;
  EXPECT_FALSE(std::is_sorted(planned.begin(), planned.end()));
  EXPECT_FALSE(std::is_sorted(planned.rbegin(), planned.rend()));
  EXPECT_LT(*std::min_element(planned.begin(), planned.end()), 21.0);
  EXPECT_GT(*std::max_element(planned.begin(), planned.end()), 23.0);
}

// Flat plates, for which the gauge is exact.
Dataset FlatDataset(std::mt19937_64& rng) {
  Dataset dataset = PoseDataset(rng, 30, false);
  dataset.hexapod = testing::SmallHexapod();
  for (RobotPose& row : dataset.robot_poses.rows)
    row.base_from_platform.translation.z() += testing::kSmallHeight - testing::kLargeHeight;
  return dataset;
}

TEST(Plan, ExactGaugesAreNamedWithTheExperimentThatWouldTell) {
  auto rng = SeededByTest();
  const Machine machine = TrueMachine(rng);
  const Dataset dataset = FlatDataset(rng);
  for (const auto& [effect, rival, experiment] :
       {std::tuple("tracker_scale",
                   "base_radius with platform_radius and leg_gain",
                   "certified length bar"),
        std::tuple("base_drift", "a tracker that moves", "markers on the base in every pose")}) {
    const Machine truth = WithEffect(machine, effect, 4.0, dataset);
    const Plan plan = MakePlan(Measured(dataset, truth, 1), truth, {});
    const RivalPair* pair = PairOf(plan, rival);
    ASSERT_NE(pair, nullptr) << effect;
    EXPECT_EQ(pair->separation, Separation::kNotByPoses) << effect;
    EXPECT_TRUE(pair->is_exact) << effect;
    EXPECT_FALSE(pair->is_absorbed) << effect;
    EXPECT_EQ(pair->poses_needed, 0) << effect;
    EXPECT_NE(pair->experiment.find(experiment), std::string::npos) << pair->experiment;
    EXPECT_GT(pair->size_before, 5.0) << effect;
    EXPECT_LT(pair->whole_pool, 0.1) << effect;
  }
}

TEST(Plan, MarkersOnTheBaseTellADriftFromAMovingTracker) {
  auto rng = SeededByTest();
  for (const bool is_static : {false, true}) {
    const Dataset dataset = testing::Plan(rng, is_static);
    const Machine truth = WithEffect(TrueMachine(rng), "base_drift", 4.0, dataset);
    PlanOptions options;
    options.pool = 60;
    options.poses = 4;
    options.goal = PlanGoal::kRivals;
    const Plan plan = MakePlan(Measured(dataset, truth, 1), truth, options);
    EXPECT_EQ(PairOf(plan, "a tracker that moves") != nullptr, is_static);
  }
}

TEST(Plan, SaysThatADescriptionHasNoLawToPlanAgainst) {
  auto rng = SeededByTest();
  Machine truth = TrueMachine(rng);
  const Dataset dataset = Measured(PoseDataset(rng, 30, true), truth, 1);
  truth.pose_map = PoseMap();
  truth.pose_map->degree = 1;
  truth.pose_map->reference.translation.z() = testing::kLargeHeight;
  truth.pose_map->half_width = Vector6d::Ones();
  truth.pose_map->coefficients = Eigen::MatrixXd::Zero(6, 7);
  PlanOptions options;
  options.pool = 60;
  const Plan plan = MakePlan(dataset, truth, options);
  EXPECT_EQ(plan.goal, PlanGoal::kParameters);
  ASSERT_EQ(plan.warnings.size(), 1u);
  EXPECT_THAT(plan.warnings[0], ::testing::HasSubstr("unknown that follows pose at the platform"));
  EXPECT_THAT(plan.warnings[0], ::testing::HasSubstr("coordinate measuring machine"));
}

TEST(Plan, RefusesADatasetThatLacksWhatAnEffectNeeds) {
  auto rng = SeededByTest();
  Dataset dataset = PoseDataset(rng, 12, true);
  AddColumn("temperature", {20.0, 22.0, 25.0}, &dataset);
  const Machine truth = WithEffect(TrueMachine(rng), "leg_thermal", 2.0, dataset);
  const Dataset measured = Measured(dataset, truth, 1);
  dataset = measured;
  dataset.robot_poses.covariates.clear();
  EXPECT_THAT(testing::InputErrorText([&] { MakePlan(dataset, truth, {}); }),
              ::testing::HasSubstr("what the model's effect 'leg_thermal' needs"));
  dataset = measured;
  dataset.measurement.reset();
  EXPECT_THROW(MakePlan(dataset, truth, {}), InputError);
}

}  // namespace
}  // namespace hexcal
