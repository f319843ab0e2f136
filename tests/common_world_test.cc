// SPDX-License-Identifier: BSD-3-Clause
// A static tracker that warms up sees the base off its place, too.
#include "discovery/common_world.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "geometry/linear_algebra.h"
#include "model/machine.h"
#include "model/predict.h"
#include "model/simulate.h"

namespace hexcal {
namespace {

Effect WarmUp() {
  const EffectKind& kind = *FindEffectKind("tracker_warmup");
  Effect effect;
  effect.name = kind.name;
  effect.parameters.resize(8);
  effect.parameters << 2e-4, -3e-4, 1e-4, 2e-4, -1e-4, 3e-4, 5e-5, 900.0;
  effect.reference["time_origin"] = {0.0};
  return effect;
}

Mounts Truth() {
  Vector6d base, tool;
  base << 0.3, -0.2, 0.1, 0.2, -0.1, 0.4;
  tool << 0.02, 0.01, 0.1, -0.2, 0.1, 0.3;
  return {Plus(Pose3d(), base), Plus(Pose3d(), tool)};
}

Dataset Seen(std::uint64_t seed) {
  Dataset dataset = ReadDataset(HEXCAL_EXAMPLES "/hidden-effect/dataset.yaml", true);
  dataset.tracker.is_static = true;
  Machine machine;
  machine.world_from_base = Truth().world_from_base;
  machine.platform_from_tool = Truth().platform_from_tool;
  machine.effects = {WarmUp()};
  SimulateOptions options;
  options.seed = seed;
  return Simulate(dataset, machine, options);
}

Refit RefitOf(const Dataset& dataset) {
  const GapData data = MakeGapData(dataset, ReportedPoses(dataset));
  const GapProblem problem = MakeGapProblem(data, Truth(), {}, {});
  GapNoise noise;
  noise.factor.assign(problem.linear.components.size(), 0.0);
  noise.factor[0] = 1.0;
  noise.weight = noise.shape_weight = Eigen::VectorXd::Ones(problem.linear.poses);
  return RefitMachine(data, Truth(), {WarmUp()}, noise, 30.0);
}

Eigen::Matrix<double, 12, 1> Miss(const Mounts& found) {
  Eigen::Matrix<double, 12, 1> miss;
  miss << Minus(found.world_from_base, Truth().world_from_base),
      Minus(found.platform_from_tool, Truth().platform_from_tool);
  return miss;
}

// Over draws, base and tool scatter about the truth as their covariance says, with what the
// readings of the base add to it.
TEST(CommonWorld, MountsAreThoseOfTheWarmTracker) {
  double sum = 0.0, largest = 0.0;
  constexpr int kDraws = 12;
  for (int seed = 1; seed <= kDraws; ++seed) {
    const Dataset seen = Seen(seed);
    const Refit refit = RefitOf(seen);
    ASSERT_TRUE(refit.converged);
    const Eigen::Matrix<double, 12, 1> miss = Miss(refit.mounts);
    Eigen::Matrix<double, 12, 12> covariance = refit.covariance.topLeftCorner<12, 12>();
    const Matrix6d carry = InverseAdjoint(refit.mounts.world_from_base);
    covariance.topLeftCorner<6, 6>() +=
        carry * ComputeToolPoses(seen).tracker_from_world_covariance * carry.transpose();
    sum += miss.dot(covariance.ldlt().solve(miss));
    largest = std::max(largest, miss.head<3>().norm());
  }
  // Chi-square of 144 degrees of freedom: 1 in 10,000 on either side.
  EXPECT_GT(sum, 88.0);
  EXPECT_LT(sum, 220.0);
  EXPECT_LT(largest, 1e-3);
}

// Residuals are what they were, and columns still tell what a step does to them.
TEST(CommonWorld, ChangesTheFrameAndNotTheResiduals) {
  const Dataset dataset = Seen(3);
  const Refit refit = RefitOf(dataset);
  for (std::size_t k = 0; k < refit.problem.seen.size(); ++k) {
    const Vector6d error = Minus(refit.problem.seen[k].world_from_tool, refit.problem.predicted[k]);
    EXPECT_LT(
        (error - refit.problem.linear.error.segment<6>(6 * static_cast<Eigen::Index>(k))).norm(),
        1e-10);
  }
  const GapData data = MakeGapData(dataset, ReportedPoses(dataset));
  const Pose3d moved = refit.mounts.world_from_base.Inverse() * Truth().world_from_base;
  EXPECT_LT(moved.translation.norm(), 1e-3);
  Machine machine;
  machine.world_from_base = refit.mounts.world_from_base;
  machine.platform_from_tool = refit.mounts.platform_from_tool;
  const std::vector<Pose3d> predicted = Predict(machine, dataset);
  for (std::size_t k = 0; k < data.rows.size(); ++k)
    EXPECT_LT(Minus(predicted[data.rows[k]], refit.problem.predicted[k]).norm(), 1e-10);
}

}  // namespace
}  // namespace hexcal
