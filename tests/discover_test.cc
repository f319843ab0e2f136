// SPDX-License-Identifier: BSD-3-Clause
// The whole chain, on a machine of which an independent simulator tells what is hidden in it.
#include "discovery/discover.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "discovery/gap_model.h"
#include "discovery/refit.h"
#include "estimator/calibrate.h"
#include "model/described_effect.h"
#include "model/predict.h"
#include "model/simulate.h"

namespace hexcal {
namespace {

const std::string kExample = HEXCAL_EXAMPLES "/hidden-effect/";

DiscoverOptions Quick() {
  DiscoverOptions options;
  options.bootstraps = 99;
  options.folds = 0;
  return options;
}

const Discovery& Found() {
  static const Discovery discovery = [] {
    DiscoverOptions options = Quick();
    options.folds = 2;
    return Discover(ReadDataset(kExample + "dataset.yaml", true), options);
  }();
  return discovery;
}

const DiscoveredEffect* Named(const Discovery& discovery, const std::string& name) {
  for (const DiscoveredEffect& found : discovery.effects)
    if (found.effect.name == name) return &found;
  return nullptr;
}

TEST(Discover, NamesBothHiddenEffectsAndNoOther) {
  EXPECT_EQ(Found().verdict, Verdict::kExplained);
  ASSERT_EQ(Found().effects.size(), 2u);
  const DiscoveredEffect* periodic = Named(Found(), "leg_periodic");
  ASSERT_NE(periodic, nullptr);
  ASSERT_NE(Named(Found(), "base_drift"), nullptr);
  EXPECT_EQ(periodic->effect.index, std::vector<int>{2});
  EXPECT_EQ(periodic->labels, std::vector<std::string>{"leg 2"});
  for (const DiscoveredEffect& found : Found().effects) EXPECT_LT(found.p_value, 1e-6);
}

// truth.json: amplitude 52.6 um, period 4.6789 mm, second harmonic a quarter of it.
TEST(Discover, SizesAgreeWithTheTruthWithinTheirDeviations) {
  const DiscoveredEffect* periodic = Named(Found(), "leg_periodic");
  ASSERT_NE(periodic, nullptr);
  const Effect& effect = periodic->effect;
  const EffectKind& kind = *FindEffectKind(effect.name);
  const std::map<std::string, double> truth = {{"amplitude", 5.2631046313374134e-05},
                                               {"amplitude_2", 0.25 * 5.2631046313374134e-05}};
  for (const auto& [name, value] : truth) {
    const int at = kind.OffsetOf(name) + 1;
    ASSERT_GT(effect.standard_deviation[at], 0.0) << name;
    EXPECT_LT(std::abs(effect.parameters[at] - value), 4.0 * effect.standard_deviation[at]) << name;
    EXPECT_LT(effect.standard_deviation[at], 0.3 * value) << name;
  }
  const int period = kind.OffsetOf("period");
  EXPECT_NEAR(effect.parameters[period], 0.004678914396052173, 2e-5);
  const Effect& drift = Named(Found(), "base_drift")->effect;
  const Vector6d twist = (Vector6d() << -2.8211064790322214e-05,
                          -0.00017295913945064855,
                          1.8259824294892305e-05,
                          -0.0006299678214479321,
                          -0.00022830239421905112,
                          -0.00022148488622279646)
                             .finished();
  for (int k = 0; k < 6; ++k)
    EXPECT_LT(std::abs(drift.parameters[k] - twist[k]), 4.5 * drift.standard_deviation[k]) << k;
}

TEST(Discover, TheGapShrinksOnPosesNeverSeen) {
  const Gap& gap = Found().gap;
  EXPECT_LT(gap.after.rms_position, gap.before.rms_position);
  EXPECT_LT(gap.heldout_after.rms_position, 1.25 * gap.noise_floor.rms_position);
  EXPECT_GT(gap.heldout_before.rms_position, 1.2 * gap.noise_floor.rms_position);
  EXPECT_NEAR(gap.after.chi_square / gap.after.degrees_of_freedom, 1.0, 0.2);
  EXPECT_GT(Found().effects.back().gap_closed, 0.85);
  EXPECT_LT(Found().effects.back().gap_closed, 1.15);
}

// In standard deviations of the noise that was found nothing else is left.
TEST(Discover, WhatPicturesAreDrawnFromIsWhatWasFound) {
  const Discovery& found = Found();
  ASSERT_EQ(found.observations.items.size(), found.poses.size());
  double before = 0.0, after = 0.0, position = 0.0;
  for (std::size_t i = 0; i < found.poses.size(); ++i) {
    EXPECT_EQ(found.observations.items[i].label, found.poses[i].label);
    before += found.poses[i].standard_before.squaredNorm();
    after += found.poses[i].standard_after.squaredNorm();
    position += found.poses[i].after.head<3>().squaredNorm();
  }
  const double numbers = 6.0 * static_cast<double>(found.poses.size());
  EXPECT_NEAR(std::sqrt(after / numbers), 1.0, 0.05);
  EXPECT_GT(std::sqrt(before / numbers), 1.2);
  ASSERT_GE(found.refit.size(), 2u);
  EXPECT_LE(found.refit.back().cost, found.refit.front().cost);
  EXPECT_NEAR(found.refit.back().rmspe,
              std::sqrt(6.0 * position / numbers),
              1e-3 * found.refit.back().rmspe);
  for (int k = 0; k < 12; ++k)
    EXPECT_NEAR(found.estimate.intervals.half_width[k],
                1.96 * std::sqrt(found.estimate.covariance(k, k)),
                0.02 * found.estimate.intervals.half_width[k]);
}

TEST(Discover, EqualSeedsGiveEqualNumbersWhateverTheThreads) {
  DiscoverOptions options = Quick();
  options.threads = 3;
  const Discovery again = Discover(ReadDataset(kExample + "dataset.yaml", true), options);
  EXPECT_EQ(WriteMachine(again.machine), WriteMachine(Found().machine));
  ASSERT_EQ(again.steps.size(), Found().steps.size());
  for (std::size_t k = 0; k < again.steps.size(); ++k)
    EXPECT_EQ(again.steps[k].p_value, Found().steps[k].p_value);
}

// The same machine without its effects, seen with the same noise.
TEST(Discover, SimulatedDataWithoutAnEffectAgree) {
  const Dataset dataset = ReadDataset(kExample + "dataset.yaml", true);
  Machine machine = Found().machine;
  machine.effects.clear();
  int agrees = 0;
  for (const std::uint64_t seed : {1, 2, 3}) {
    SimulateOptions options;
    options.seed = seed;
    const Discovery discovery = Discover(Simulate(dataset, machine, options), Quick());
    agrees += discovery.verdict == Verdict::kAgrees && discovery.effects.empty();
  }
  EXPECT_EQ(agrees, 3);
}

// The grown model, run forward, hides what was found; it must be found again.
TEST(Discover, WhatTheGrownModelSimulatesIsFoundAgain) {
  const Dataset dataset = ReadDataset(kExample + "dataset.yaml", true);
  const Discovery again = Discover(Simulate(dataset, Found().machine, {}), Quick());
  EXPECT_NE(Named(again, "leg_periodic"), nullptr);
  EXPECT_NE(Named(again, "base_drift"), nullptr);
  EXPECT_EQ(again.effects.size(), 2u);
}

TEST(Discover, ShiftedRowsAreMendedFirst) {
  Dataset dataset = ReadDataset(kExample + "dataset.yaml", true);
  Machine machine = Found().machine;
  machine.effects.clear();
  dataset = Simulate(dataset, machine, {});
  std::vector<RobotPose>& rows = dataset.robot_poses.rows;
  for (std::size_t i = rows.size() - 1; i > 0; --i)
    rows[i].base_from_platform = rows[i - 1].base_from_platform;
  const Discovery discovery = Discover(dataset, Quick());
  ASSERT_EQ(discovery.effects.size(), 1u);
  EXPECT_EQ(discovery.effects[0].effect.name, "shifted_rows");
}

// Scales of the tracker and of the machine are one and the same in measured poses.
TEST(Discover, AnExactGaugeHasNoSingleName) {
  const Dataset dataset = ReadDataset(kExample + "dataset.yaml", true);
  Machine machine = Found().machine;
  Effect scale;
  scale.name = "tracker_scale";
  scale.parameters = Eigen::VectorXd::Constant(1, 3e-3);
  machine.effects = {scale};
  Dataset seen = Simulate(dataset, machine, {});
  const ToolPoses tools = ComputeToolPoses(seen);
  Measurement poses;
  poses.kind = Measurement::Kind::kPoses;
  for (const ToolPose& tool : tools.poses) poses.poses.push_back({tool.pose, tool.world_from_tool});
  PoseNoise noise;
  noise.position.setConstant(3e-5), noise.orientation.setConstant(3e-4);
  poses.pose_noise = noise;
  poses.where = seen.measurement->where;
  seen.measurement = poses;
  const Discovery discovery = Discover(seen, Quick());
  ASSERT_FALSE(discovery.effects.empty());
  EXPECT_FALSE(discovery.effects[0].could_also_be.empty());
}

TEST(Refit, EndsWhereTheGradientVanishes) {
  const Dataset dataset = ReadDataset(kExample + "dataset.yaml", true);
  const GapData data = MakeGapData(dataset, ReportedPoses(dataset));
  const Estimate alone = Calibrate(MakeObservations(dataset), std::nullopt, {});
  const Effect* drift = &Named(Found(), "base_drift")->effect;
  Effect start = *drift;
  start.parameters.setZero();
  const Mounts mounts = {alone.mounts.world_from_base, alone.mounts.platform_from_tool};
  const GapProblem problem = MakeGapProblem(data, mounts, {}, {});
  GapNoise noise;
  noise.factor.assign(problem.linear.components.size(), 0.0);
  noise.factor[0] = 1.0;
  noise.weight = noise.shape_weight = Eigen::VectorXd::Ones(problem.linear.poses);
  const Refit refit = RefitMachine(data, mounts, {start}, noise, 30.0);
  ASSERT_TRUE(refit.converged);
  // Least squares by hand at the solution: the gradient vanishes, priors being wide.
  const LinearProblem& linear = refit.problem.linear;
  const Eigen::MatrixXd j = WhitenPoseRows(linear, noise, linear.With({0}).nuisance);
  const Eigen::VectorXd r = WhitenPoseRows(linear, noise, linear.error);
  const Eigen::VectorXd gradient = j.transpose() * r;
  for (Eigen::Index k = 0; k < gradient.size(); ++k)
    EXPECT_LT(std::abs(gradient[k]), 2e-2 * j.col(k).norm()) << k;
}

}  // namespace
}  // namespace hexcal
