// SPDX-License-Identifier: BSD-3-Clause
// What effects of a model look like in a plan, against the exact forward model.
#include "discovery/rival_models.h"

#include <gtest/gtest.h>

#include "model/simulate.h"
#include "testing/effects.h"
#include "testing/grown_scene.h"

namespace hexcal {
namespace {

using ::hexcal::testing::SeededByTest;
using ::hexcal::testing::SomeEffect;
using ::hexcal::testing::TrueMachine;

struct Scene {
  Dataset dataset;
  std::vector<Pose3d> reported;
  std::vector<Visit> visits;
};

template <typename Rng>
Scene MakeScene(Rng& rng) {
  Scene scene;
  scene.dataset = testing::Plan(rng, false);
  for (const RobotPose& row : scene.dataset.robot_poses.rows)
    scene.reported.push_back(row.base_from_platform);
  scene.dataset.hexapod->home = HomePose(nullptr, scene.reported);
  scene.visits = MakeVisits(scene.dataset, &*scene.dataset.hexapod, scene.reported);
  return scene;
}

Dataset SeenWithoutNoise(const Scene& scene, const Machine& machine) {
  SimulateOptions exact;
  exact.noise = 0.0;
  return Simulate(scene.dataset, machine, exact);
}

TEST(RivalModels, SignalsAreWhatTheEffectsLeaveBehind) {
  auto rng = SeededByTest();
  const Scene scene = MakeScene(rng);
  int kinds = 0;
  for (const EffectKind& kind : EffectKinds()) {
    if (kind.IsFault()) continue;
    Machine machine = TrueMachine(rng);
    machine.effects = {SomeEffect(rng, kind, scene.visits, scene.dataset, 0.5)};
    const Mounts mounts = {machine.world_from_base, machine.platform_from_tool};
    const Dataset seen = SeenWithoutNoise(scene, machine);
    const GapData data = MakeGapData(seen, scene.reported);
    const PlanForms own = OwnForms(machine.effects);
    const LinearProblem with = MakeGapProblem(data, mounts, machine.effects, own.library).linear;
    const LinearProblem without = MakeGapProblem(data, mounts, {}, {}).linear;
    const Form& signal = with.forms[0];
    const Eigen::VectorXd foretold =
        with.columns->middleCols(signal.first, signal.size) * own.signals[0];
    const double size = without.error.norm();
    ASSERT_GT(size, 1e-7) << kind.name;
    EXPECT_LT(with.error.norm(), 1e-3 * size) << kind.name;
    EXPECT_LT((foretold - without.error).norm(), 0.02 * size) << kind.name;
    ++kinds;
  }
  EXPECT_EQ(kinds, 30);
}

TEST(RivalModels, AnEffectIsMeasuredWithTheOthersFree) {
  auto rng = SeededByTest();
  const Scene scene = MakeScene(rng);
  std::vector<Effect> effects;
  for (const char* name : {"leg_gain", "tool_sag"})
    effects.push_back(SomeEffect(rng, *FindEffectKind(name), scene.visits, scene.dataset, 1.0));
  Machine machine = TrueMachine(rng);
  machine.effects = effects;
  const Dataset seen = SeenWithoutNoise(scene, machine);
  const GapData data = MakeGapData(seen, scene.reported);
  const PlanForms own = OwnForms(effects);
  const LinearProblem problem =
      MakeGapProblem(
          data, {machine.world_from_base, machine.platform_from_tool}, effects, own.library)
          .linear;
  GapNoise noise;
  noise.factor = {1.0, 0.0, 0.0};
  noise.weight = noise.shape_weight = Eigen::VectorXd::Ones(problem.poses);
  const DesignRows rows = MakeDesignRows(problem, noise);
  const DesignModels models = MakeDesignModels(own, effects, problem, rows);
  // Six gains, two numbers of the sag, the 12.
  EXPECT_EQ(models.parameters.columns.cols(), 6 + 2 + 12);
  EXPECT_EQ(models.parameters.nuisances, 8);
  EXPECT_TRUE((models.parameters.prior.head(8).array() > 0.0).all());
  EXPECT_TRUE(models.parameters.prior.tail(12).isZero(0.0));
  ASSERT_EQ(models.effects.size(), 2u);
  EXPECT_EQ(models.effects[0].columns.cols(), 12 + 2);
  EXPECT_EQ(models.effects[1].columns.cols(), 12 + 6);
  // The rows of a pose: its error and the misfit of 4 + 4 markers but for 12 rigid motions.
  EXPECT_EQ(rows.first[1] - rows.first[0], 6 + 12);
  EXPECT_EQ(rows.poses(), testing::kGrownPoses);
  // Whitened: the first component's inverse is the information on a pose.
  const Matrix6d nuisance = rows.nuisance.topLeftCorner<6, 6>();
  const Matrix6d raw = problem.nuisance.topLeftCorner<6, 6>();
  const Matrix6d information = raw.transpose() * problem.components[0][0].llt().solve(raw);
  EXPECT_LT((nuisance.transpose() * nuisance - information).norm(), 1e-8 * information.norm());
}

TEST(RivalModels, RivalsAreThoseOfTheDataWhereTheModelHasHalfOfTheEffect) {
  auto rng = SeededByTest();
  const Scene scene = MakeScene(rng);
  Machine machine = TrueMachine(rng);
  machine.effects = {
      SomeEffect(rng, *FindEffectKind("leg_gain"), scene.visits, scene.dataset, 2.0)};
  SimulateOptions with_noise;
  const Dataset seen = Simulate(scene.dataset, machine, with_noise);
  machine.effects[0].parameters *= 0.5;
  const PlanScene plan = MakePlanScene(seen, machine);
  const GapData data = MakeGapData(plan.dataset, plan.reported);
  GapNoise noise;
  noise.factor = {1.0, 0.0, 0.0};
  noise.weight = noise.shape_weight = Eigen::VectorXd::Ones(testing::kGrownPoses);
  const PlanForms forms =
      WithRivals(plan, data, {machine.world_from_base, machine.platform_from_tool}, noise);
  // Were half of the effect taken off once more, nothing would be left and all would be rivals.
  EXPECT_LT(forms.rivals.size(), 4u);
}

TEST(RivalModels, OfSomeFormsWhatTheyShareComesAlong) {
  auto rng = SeededByTest();
  const Scene scene = MakeScene(rng);
  Machine machine = TrueMachine(rng);
  const Dataset seen = SeenWithoutNoise(scene, machine);
  const GapData data = MakeGapData(seen, scene.reported);
  const FormLibrary whole = MakeFormLibrary(seen, data.visits, data.rows);
  std::vector<int> asked, places;
  for (std::size_t f = 0; f < whole.forms.size(); f += 37) asked.push_back(static_cast<int>(f));
  const FormLibrary some = SomeForms(whole, asked, &places);
  const Mounts mounts = {machine.world_from_base, machine.platform_from_tool};
  const LinearProblem all = MakeGapProblem(data, mounts, {}, whole).linear;
  const LinearProblem few = MakeGapProblem(data, mounts, {}, some).linear;
  ASSERT_EQ(places.size(), asked.size());
  EXPECT_LT(few.columns->cols(), all.columns->cols());
  for (std::size_t k = 0; k < asked.size(); ++k) {
    const Form& a = all.forms[asked[k]];
    const Form& b = few.forms[places[k]];
    ASSERT_EQ(a.size, b.size);
    EXPECT_EQ(a.family, b.family);
    EXPECT_EQ(all.columns->middleCols(a.first, a.size), few.columns->middleCols(b.first, b.size))
        << asked[k];
  }
}

}  // namespace
}  // namespace hexcal
