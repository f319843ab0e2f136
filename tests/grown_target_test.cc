// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/grown_target.h"

#include <gtest/gtest.h>

#include <cmath>

#include "estimator/target_error.h"
#include "testing/matchers.h"
#include "testing/model_scene.h"
#include "testing/random.h"

namespace hexcal {
namespace {

using ::hexcal::testing::CalibrateModel;
using ::hexcal::testing::JacobianNear;
using ::hexcal::testing::MakeModelScene;
using ::hexcal::testing::MatrixNear;
using ::hexcal::testing::ModelScene;
using ::hexcal::testing::NumericJacobian;
using ::hexcal::testing::SeededByTest;

class EffectTarget : public ::testing::TestWithParam<std::string> {};

// At a place that nobody visited, and at one of the poses.
TEST_P(EffectTarget, JacobianIsTheDerivative) {
  auto rng = SeededByTest();
  const ModelScene scene = MakeModelScene(rng, {GetParam()}, 30);
  const auto made = CalibrateModel(scene, 1, true);
  const GrownTarget& target = *made->target;
  for (const int row : {GrownTarget::kNoRow, 7}) {
    const Pose3d pose =
        row < 0 ? scene.place() : made->dataset.robot_poses.rows[row].base_from_platform;
    const auto at = target.At(pose, row);
    ASSERT_TRUE(at);
    const Pose3d tool = at->chain.WorldFromTool();
    // Steps of a thousandth of a standard deviation, whatever the unit.
    const Eigen::VectorXd sigma = 1e-3 * target.covariance().diagonal().cwiseSqrt();
    const auto moved = [&](const Eigen::VectorXd& d) -> Eigen::VectorXd {
      const Eigen::VectorXd step = 1e6 * d.cwiseProduct(sigma);
      return Minus(target.ChainAt(pose, row, step)->WorldFromTool(), tool);
    };
    const Eigen::MatrixXd numeric = NumericJacobian(moved, static_cast<int>(target.size()), 1e-6);
    const Eigen::MatrixXd exact = at->by_parameters * (1e6 * sigma).asDiagonal();
    EXPECT_TRUE(JacobianNear(exact, numeric, 1e-6)) << row;
    EXPECT_GT(exact.leftCols<12>().norm(), 0.0);
  }
}

// The machine predicts what `predict` does with the model that it writes.
TEST_P(EffectTarget, IsWhatTheModelPredicts) {
  auto rng = SeededByTest();
  const ModelScene scene = MakeModelScene(rng, {GetParam()}, 30);
  const auto made = CalibrateModel(scene, 1, true);
  const Pose3d predicted = Predict(made->grown.machine, scene.at_place)[0];
  const auto at = made->target->At(scene.place(), GrownTarget::kNoRow);
  ASSERT_TRUE(at);
  EXPECT_TRUE(testing::PoseNear(at->chain.WorldFromTool(), predicted, 1e-12, 1e-12));
  const auto all = Predict(made->grown.machine, made->dataset);
  for (const int row : {0, 11, 29}) {
    const Pose3d& pose = made->dataset.robot_poses.rows[row].base_from_platform;
    EXPECT_TRUE(testing::PoseNear(
        made->target->At(pose, row)->chain.WorldFromTool(), all[row], 1e-12, 1e-12))
        << row;
  }
}

INSTANTIATE_TEST_SUITE_P(Effects,
                         EffectTarget,
                         ::testing::Values("leg_gain",
                                           "leg_backlash",
                                           "leg_compliance",
                                           "base_joint_offset",
                                           "base_drift",
                                           "base_flexure",
                                           "tool_thermal",
                                           "latency",
                                           "settling",
                                           "tracker_scale"),
                         [](const auto& tested) { return tested.param; });

// What only the tracker does moves no tool.
TEST(GrownTarget, TrackerEffectsCountByTheirCorrelationAlone) {
  auto rng = SeededByTest();
  const ModelScene scene = MakeModelScene(rng, {"tracker_scale"}, 30);
  const auto made = CalibrateModel(scene, 1, true);
  const auto at = made->target->At(scene.place(), GrownTarget::kNoRow);
  EXPECT_TRUE(at->by_parameters.col(12).isZero(0.0));
  const TargetCovariance with =
      TargetError(made->grown.estimate, {}, made->target).At(scene.place(), scene.p_in_tool);
  EXPECT_GT(with.of_effects.trace(), 0.0);
  // The 12 alone, of the joint covariance: the same.
  const TargetCovariance without =
      TargetError(made->grown.estimate, {}).At(scene.place(), scene.p_in_tool);
  EXPECT_TRUE(MatrixNear(with.total, without.total, 1e-9));
}

// A model without an effect is base and tool alone.
TEST(GrownTarget, WithoutEffectsIsTheErrorOfBaseAndTool) {
  auto rng = SeededByTest();
  const ModelScene scene = MakeModelScene(rng, {}, 30);
  const auto made = CalibrateModel(scene, 1, true);
  const ErrorSource robot = {"robot", SourceSite::kPlatform, 1e-5, 5e-5};
  const TargetCovariance with =
      TargetError(made->grown.estimate, {robot}, made->target).At(scene.place(), scene.p_in_tool);
  const TargetCovariance without =
      TargetError(made->grown.estimate, {robot}).At(scene.place(), scene.p_in_tool);
  EXPECT_TRUE(MatrixNear(with.total, without.total, 1e-12));
  EXPECT_NEAR((with.p_in_world - without.p_in_world).norm(), 0.0, 1e-14);
  EXPECT_NEAR(with.Quantile(0.95) / without.Quantile(0.95), 1.0, 1e-12);
  EXPECT_LT(std::abs(with.of_effects.trace()), 1e-9 * with.total.trace());
  EXPECT_EQ(with.by_priors.trace(), 0.0);
}

// Two levels that few poses tell, as base and tool alone have it by other code.
TEST(GrownTarget, OfAnEstimatedNoiseIsAsWideAsBaseAndToolAloneHaveIt) {
  auto rng = SeededByTest();
  const ModelScene scene = MakeModelScene(rng, {}, 10);
  const auto made = CalibrateModel(scene, 1, false);
  const TargetCovariance with =
      TargetError(made->grown.estimate, {}, made->target).At(scene.place(), scene.p_in_tool);
  const Estimate alone = Calibrate(made->grown.solution->observations, std::nullopt, {});
  const TargetCovariance without = TargetError(alone, {}).At(scene.place(), scene.p_in_tool);
  EXPECT_NEAR(with.Rms() / without.Rms(), 1.0, 0.02);
  EXPECT_NEAR(with.Quantile(0.95) / without.Quantile(0.95), 1.0, 0.03);
  EXPECT_GT(with.calibration.trace(),
            (TargetError(made->grown.estimate, {}).At(scene.place(), scene.p_in_tool))
                .calibration.trace());
}

// The parts: what is left were the effects known is what a fit that holds them says; priors that
// are all there is are all of it.
TEST(GrownTarget, PartsOfTheCovarianceAreWhatTheySay) {
  auto rng = SeededByTest();
  const ModelScene scene = MakeModelScene(rng, {"leg_gain", "tool_thermal"}, 30);
  const auto made = CalibrateModel(scene, 1, true);
  const GrownSolution& solution = *made->grown.solution;
  std::vector<GrownEffect> held;
  for (const Effect& effect : solution.fit.effects) held.push_back({effect, {}, {}, {}});
  const GrownFit alone = FitGrown(GrownProblem(solution.data, held), solution.fit.mounts, {}, {});
  EXPECT_TRUE(MatrixNear(
      Eigen::MatrixXd(made->target->covariance_of_known_effects()), alone.covariance, 1e-6));
  const TargetCovariance at =
      TargetError(made->grown.estimate, {}, made->target).At(scene.place(), scene.p_in_tool);
  EXPECT_GT(at.of_effects.trace(), 0.1 * at.calibration.trace());
  EXPECT_LT(at.of_effects.trace(), at.calibration.trace());
  EXPECT_GT(at.by_priors.trace(), 0.0);
  EXPECT_LT(at.by_priors.trace(), 0.05 * at.calibration.trace());
  // A million times the poses' noise: the effects are as their priors have them.
  GrownSolution rough;
  rough.dataset = solution.dataset, rough.hexapod = solution.hexapod, rough.home = solution.home;
  rough.visits = solution.visits, rough.data = solution.data, rough.effects = solution.effects;
  rough.data.visits = &rough.visits, rough.data.hexapod = &*rough.hexapod;
  for (GrownPose& pose : rough.data.poses) pose.whitener *= 1e-6;
  rough.fit = FitGrown(rough.Problem(), solution.fit.mounts, {}, {});
  const std::shared_ptr<const GrownSolution> shared(std::shared_ptr<void>(), &rough);
  const GrownTarget by_priors(shared);
  const Eigen::VectorXd share = by_priors.covariance_by_priors().diagonal().tail(12).cwiseQuotient(
      by_priors.covariance().diagonal().tail(12));
  EXPECT_GT(share.minCoeff(), 0.999);
}

// Where the true point is, over whole measurements and joint fits. benchmarks/model_coverage_study
// is the long version.
class ModelCoverage : public ::testing::TestWithParam<bool> {};

TEST_P(ModelCoverage, OfTheStatedLengthIs95Percent) {
  constexpr int kDraws = 300;
  auto rng = SeededByTest();
  const ModelScene scene = MakeModelScene(rng, {"leg_gain"}, 16);
  int inside = 0;
  for (int k = 0; k < kDraws; ++k)
    inside += testing::IsWithinLength(scene, *CalibrateModel(scene, 100 + k, GetParam()));
  const double share = static_cast<double>(inside) / kDraws;
  RecordProperty("coverage", std::to_string(share));
  // Three and a half standard errors of the count.
  EXPECT_NEAR(share, 0.95, 3.5 * std::sqrt(0.95 * 0.05 / kDraws));
}

INSTANTIATE_TEST_SUITE_P(Noise,
                         ModelCoverage,
                         ::testing::Values(true, false),
                         [](const auto& tested) { return tested.param ? "Stated" : "Estimated"; });

}  // namespace
}  // namespace hexcal
