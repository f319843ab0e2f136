// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/calibrate_grown.h"

#include <cmath>

#include "model/predict.h"
#include "model/simulate.h"
#include "testing/effects.h"
#include "testing/grown_scene.h"
#include "testing/matchers.h"
#include "testing/random.h"
#include "testing/scenes.h"

namespace hexcal {
namespace {

using testing::PoseNear;
using testing::SeededByTest;

Effect Of(const std::string& name, std::mt19937_64& rng, const Dataset& plan) {
  const std::vector<Visit> visits = MakeVisits(plan, &*plan.hexapod, ReportedPoses(plan));
  return testing::SomeEffect(rng, *FindEffectKind(name), visits, plan, 1.0);
}

// The effects of another day: half of what they are now.
Machine Stale(const Machine& truth) {
  Machine stale = truth;
  Vector6d moved;
  moved << 0.02, -0.03, 0.01, 0.05, -0.02, 0.04;
  stale.world_from_base = Plus(truth.world_from_base, moved);
  stale.platform_from_tool = Plus(truth.platform_from_tool, Vector6d(-0.3 * moved));
  for (Effect& effect : stale.effects) effect.parameters *= 0.5;
  return stale;
}

void ExpectWithin(const GrownCalibration& result, const Machine& truth, double sigmas) {
  ASSERT_TRUE(result.estimate.converged);
  for (std::size_t e = 0; e < truth.effects.size(); ++e) {
    const Effect& found = result.machine.effects[e];
    for (int k = 0; k < found.parameters.size(); ++k)
      EXPECT_LT(std::abs(found.parameters[k] - truth.effects[e].parameters[k]),
                sigmas * found.standard_deviation[k])
          << found.name << " " << k;
  }
  const auto off = testing::Difference(result.estimate.mounts,
                                       {truth.world_from_base, truth.platform_from_tool});
  for (int k = 0; k < 12; ++k)
    EXPECT_LT(std::abs(off[k]), sigmas * std::sqrt(result.estimate.covariance(k, k))) << k;
}

TEST(CalibrateGrown, FindsWhatTheEffectsAreOnNewData) {
  std::mt19937_64 rng = SeededByTest();
  const Dataset plan = testing::Plan(rng, false);
  Machine truth = testing::TrueMachine(rng);
  truth.effects = {Of("leg_gain", rng, plan), Of("tracker_scale", rng, plan)};
  const Dataset dataset = Simulate(plan, truth, {3, 1.0});
  const GrownCalibration result = CalibrateGrown(dataset, Stale(truth), {});
  ExpectWithin(result, truth, 4.5);
  const double freedom = 6.0 * testing::kGrownPoses - 12 - 7;
  EXPECT_EQ(result.estimate.degrees_of_freedom, freedom);
  EXPECT_NEAR(result.estimate.chi_square / freedom, 1.0, 4 * std::sqrt(2 / freedom));
  EXPECT_FALSE(result.estimate.noise.estimated);
  const std::vector<Pose3d> real = Predict(truth, dataset);
  const std::vector<Pose3d> predicted = Predict(result.machine, dataset);
  for (std::size_t i = 0; i < real.size(); ++i)
    EXPECT_TRUE(PoseNear(predicted[i], real[i], 5e-5, 5e-4)) << i;
}

TEST(CalibrateGrown, EstimatesANoiseThatIsNotStated) {
  std::mt19937_64 rng = SeededByTest();
  const Dataset plan = testing::Plan(rng, false);
  Machine truth = testing::TrueMachine(rng);
  truth.effects = {Of("leg_gain", rng, plan)};
  Dataset dataset = Simulate(plan, truth, {4, 1.0});
  const GrownCalibration stated = CalibrateGrown(dataset, Stale(truth), {});
  dataset.measurement->marker_sigma.reset();
  const GrownCalibration result = CalibrateGrown(dataset, Stale(truth), {});
  EXPECT_TRUE(result.estimate.noise.estimated);
  EXPECT_NEAR(result.estimate.noise.position / stated.estimate.noise.position, 1.0, 0.3);
  ExpectWithin(result, truth, 4.5);
}

TEST(CalibrateGrown, MendsFaultsAndKeepsThemInTheModel) {
  std::mt19937_64 rng = SeededByTest();
  const Dataset plan = testing::Plan(rng, false);
  Machine truth = testing::TrueMachine(rng);
  Dataset dataset = Simulate(plan, truth, {5, 1.0});
  for (RobotPose& row : dataset.robot_poses.rows) row.base_from_platform.translation *= 1e-3;
  Effect fault;
  fault.name = "wrong_unit";
  fault.found["of"] = "lengths";
  fault.reference["factor"] = {1e3};
  Machine model = Stale(truth);
  model.effects = {fault};
  const GrownCalibration result = CalibrateGrown(dataset, model, {});
  EXPECT_NEAR(result.estimate.noise_scale, 1.0, 0.15);
  ASSERT_EQ(result.machine.effects.size(), 1u);
  EXPECT_EQ(result.machine.effects[0].found, fault.found);
  EXPECT_TRUE(PoseNear(result.machine.world_from_base, truth.world_from_base, 1e-4, 1e-3));
}

TEST(CalibrateGrown, RefusesADatasetWithoutWhatAnEffectNeeds) {
  std::mt19937_64 rng = SeededByTest();
  const Dataset plan = testing::Plan(rng, false);
  Machine truth = testing::TrueMachine(rng);
  truth.effects = {Of("leg_thermal", rng, plan)};
  Dataset dataset = Simulate(plan, truth, {6, 1.0});
  dataset.robot_poses.covariates.erase(dataset.robot_poses.covariates.begin());
  EXPECT_THROW(CalibrateGrown(dataset, truth, {}), InputError);
}

}  // namespace
}  // namespace hexcal
