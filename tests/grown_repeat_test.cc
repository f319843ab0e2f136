// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/grown_repeat.h"

#include <gtest/gtest.h>

#include <cmath>

#include "estimator/pose_check.h"
#include "estimator/target_check.h"
#include "testing/matchers.h"
#include "testing/model_scene.h"
#include "testing/random.h"

namespace hexcal {
namespace {

using ::hexcal::testing::CalibrateModel;
using ::hexcal::testing::MakeModelScene;
using ::hexcal::testing::MatrixNear;
using ::hexcal::testing::ModelScene;
using ::hexcal::testing::SeededByTest;

MonteCarloOptions Few() {
  MonteCarloOptions options;
  options.draws = 100;
  options.keep_draws = true;
  return options;
}

// The scatter of the repeated fits is the joint covariance, with effects of the robot and of the
// tracker, and what the target's error is by it.
TEST(GrownRepeat, ScattersAsTheJointCovarianceSays) {
  auto rng = SeededByTest();
  const ModelScene scene = MakeModelScene(rng, {"leg_gain", "tracker_scale"}, 20);
  const auto made = CalibrateModel(scene, 1, true);
  const GrownSolution& solution = *made->grown.solution;
  const PropagationCheck check = CheckGrownPropagation(solution, made->grown.estimate, Few());
  ASSERT_TRUE(check.done) << check.why_not;
  EXPECT_EQ(check.not_converged, 0);
  ASSERT_EQ(check.estimates.rows(), 12 + 6 + 1);
  ASSERT_EQ(check.estimates.cols(), check.draws);
  const Eigen::VectorXd sigma = solution.CovarianceUnscaled().diagonal().cwiseSqrt();
  const Eigen::MatrixXd whitened = sigma.cwiseInverse().asDiagonal() * check.estimates;
  const Eigen::MatrixXd found = whitened * whitened.transpose() / check.draws;
  const Eigen::MatrixXd expected = sigma.cwiseInverse().asDiagonal() *
                                   solution.CovarianceUnscaled() *
                                   sigma.cwiseInverse().asDiagonal();
  // Correlations: five standard errors, sqrt(2 / n) on the diagonal.
  EXPECT_TRUE(MatrixNear(found, expected, 5.0 * std::sqrt(2.0 / check.draws)));
  const TargetCheck target = CheckTarget(made->grown.estimate,
                                         {{"robot", SourceSite::kPlatform, 1e-5, 5e-5}},
                                         check,
                                         scene.place(),
                                         scene.p_in_tool,
                                         0.95,
                                         1,
                                         made->target);
  EXPECT_EQ(target.draws, check.draws);
  EXPECT_NEAR(target.repeated_rms / target.rms, 1.0, 5.0 / std::sqrt(2.0 * check.draws));
  EXPECT_TRUE(target.agrees) << target.quantile << " " << target.repeated_quantile;
}

// The curvature of a wave's phase grows as the square of its height, which noise moves by a quarter
// here: steps by the curvature of the solution would not arrive.
TEST(GrownRepeat, ArrivesWithAWaveOfFourTimesItsUncertainty) {
  auto rng = SeededByTest();
  ModelScene scene = MakeModelScene(rng, {"leg_periodic"}, 40);
  for (Effect* effect : {&scene.truth.effects[0], &scene.model.effects[0]}) {
    const Effect all = *effect;
    effect->parameters.setZero();
    for (const int number : {1, 7, 12, 14, 20})  // of the second leg
      effect->parameters[number] = all.parameters[number];
    effect->parameters[12] = 0.005;
    effect->parameters[1] = 5e-5, effect->parameters[14] = 3e-5;
  }
  MonteCarloOptions options = Few();
  options.most_rounds = 1;
  const auto made = CalibrateModel(scene, 1, true);
  const PropagationCheck check =
      CheckGrownPropagation(*made->grown.solution, made->grown.estimate, options);
  ASSERT_TRUE(check.done) << check.why_not;
  EXPECT_LE(check.not_converged, 1) << check.draws;
}

TEST(GrownRepeat, IsTheSameForAnyNumberOfThreads) {
  auto rng = SeededByTest();
  const ModelScene scene = MakeModelScene(rng, {"tool_thermal"}, 16);
  const auto made = CalibrateModel(scene, 1, true);
  MonteCarloOptions options = Few();
  const PropagationCheck one =
      CheckGrownPropagation(*made->grown.solution, made->grown.estimate, options);
  options.threads = 3;
  const PropagationCheck three =
      CheckGrownPropagation(*made->grown.solution, made->grown.estimate, options);
  ASSERT_TRUE(one.done);
  EXPECT_EQ(one.estimates, three.estimates);
}

// Held out by the formula is held out by leaving out and fitting again, jointly.
TEST(GrownPoseCheck, HeldOutErrorIsThatOfAJointFitWithoutThePose) {
  auto rng = SeededByTest();
  const ModelScene scene = MakeModelScene(rng, {"leg_gain"}, 24);
  const auto made = CalibrateModel(scene, 1, true);
  const GrownSolution& solution = *made->grown.solution;
  const auto checks = CheckPoses(solution, 0.01, 0.8);
  ASSERT_EQ(checks.size(), solution.rows.size());
  for (const std::size_t left_out : {0u, 5u, 23u}) {
    GrownProblem::Data data = solution.data;
    data.poses.erase(data.poses.begin() + static_cast<std::ptrdiff_t>(left_out));
    const GrownFit without =
        FitGrown(GrownProblem(data, solution.effects), solution.fit.mounts, {}, {});
    const auto all = solution.Problem().Evaluate(without.mounts, without.free, false);
    const Vector6d difference = checks[left_out].held_out - all->errors[left_out];
    EXPECT_LT(difference.head<3>().norm(), 1e-8) << checks[left_out].label;
    EXPECT_LT(difference.tail<3>().norm(), 1e-7) << checks[left_out].label;
    EXPECT_GT(difference.norm(), 0.0);
  }
}

// Without an effect it is what base and tool alone have.
TEST(GrownPoseCheck, WithoutEffectsIsThatOfBaseAndTool) {
  auto rng = SeededByTest();
  const ModelScene scene = MakeModelScene(rng, {}, 24);
  const auto made = CalibrateModel(scene, 1, true);
  const GrownSolution& solution = *made->grown.solution;
  const auto with = CheckPoses(solution, 0.01, 0.8);
  const auto without =
      CheckPoses(solution.observations, made->grown.estimate.mounts, {}, 0.01, 0.8);
  ASSERT_EQ(with.size(), without.size());
  for (std::size_t i = 0; i < with.size(); ++i) {
    EXPECT_TRUE(MatrixNear(with[i].held_out, without[i].held_out, 1e-10));
    EXPECT_NEAR(with[i].squared / without[i].squared, 1.0, 1e-8);
    EXPECT_NEAR(with[i].smallest_position / without[i].smallest_position, 1.0, 1e-8);
    EXPECT_NEAR(with[i].redundancy, without[i].redundancy, 1e-8);
  }
}

}  // namespace
}  // namespace hexcal
