// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/grown_fit.h"

#include <algorithm>
#include <cmath>

#include "estimator/calibrate.h"
#include "estimator/free_effect.h"
#include "measurement/tool_pose.h"
#include "model/machine.h"
#include "model/predict.h"
#include "model/simulate.h"
#include "residuals/whitener.h"
#include "testing/effects.h"
#include "testing/grown_scene.h"
#include "testing/matchers.h"
#include "testing/random.h"

namespace hexcal {
namespace {

using testing::JacobianNear;
using testing::MatrixNear;
using testing::NumericJacobian;
using testing::Plan;
using testing::SeededByTest;
using testing::TrueMachine;

// Everything that a fit needs, kept together.
struct Scene {
  Dataset dataset;
  std::vector<Visit> visits;

  explicit Scene(Dataset measured) : dataset(std::move(measured)) {
    visits = MakeVisits(dataset, &*dataset.hexapod, ReportedPoses(dataset));
  }
  GrownProblem::Data Data() const {
    GrownProblem::Data data;
    data.dataset = &dataset;
    data.hexapod = &*dataset.hexapod;
    data.visits = &visits;
    data.with_misfit = true;
    for (const ToolPose& pose : ComputeToolPoses(dataset).poses)
      data.poses.push_back({pose.pose, pose.world_from_tool, WhitenerOf(pose.covariance)});
    return data;
  }
};

Mounts Near(const Machine& machine) {
  Vector6d off;
  off << 1e-3, -2e-3, 1e-3, 1e-3, 2e-3, -1e-3;
  return {Plus(machine.world_from_base, off), Plus(machine.platform_from_tool, off)};
}

void ExpectMounts(const Mounts& mounts, const Machine& truth, double tolerance) {
  EXPECT_TRUE(
      testing::PoseNear(mounts.world_from_base, truth.world_from_base, tolerance, tolerance));
  EXPECT_TRUE(
      testing::PoseNear(mounts.platform_from_tool, truth.platform_from_tool, tolerance, tolerance));
}

// Exact gauges, which no data break: all base joints moved as one are a base that stands elsewhere
// (the platform's: a tool), and a tracker that moves carries both bodies with it where the base's
// markers are measured in every pose. Six numbers of the joints are held at the truth, enough to
// pin such a motion; the tracker stands still. A platform that gives way along gravity by the same
// amount in every pose (tool_sag's deflection) is a base that stands lower.
std::vector<int> Held(const EffectKind& kind) {
  if (kind.name == "base_joint_offset" || kind.name == "platform_joint_offset")
    return {0, 1, 2, 6, 8, 14};
  if (kind.name == "tool_sag") return {0};
  return {};
}

GrownEffect WithoutPriors(const Effect& truth, const EffectKind& kind) {
  GrownEffect grown = FreeEffect(truth, 1.0);
  for (const int number : Held(kind))
    grown.free.erase(std::find(grown.free.begin(), grown.free.end(), number));
  const auto size = static_cast<Eigen::Index>(grown.free.size());
  grown.prior_mean.setZero(size);
  grown.prior_sigma = Eigen::VectorXd::Constant(size, std::numeric_limits<double>::infinity());
  return grown;
}

// Off by a twentieth; what is searched for by a ten-thousandth.
Eigen::VectorXd StartNear(const GrownEffect& truth, const EffectKind& kind) {
  Eigen::VectorXd start(truth.free.size());
  for (std::size_t k = 0; k < truth.free.size(); ++k)
    start[static_cast<Eigen::Index>(k)] =
        truth.effect.parameters[truth.free[k]] *
        (kind.ParameterOf(truth.free[k]).is_search ? 1.0001 : 0.95);
  return start;
}

// A model whose errors are large says so beforehand; one whose errors are small, or none, does not.
TEST(FreeEffect, HasPriorsAsWideAsTheModelIsLarge) {
  Effect effect;
  effect.name = "leg_gain";
  effect.index = {2, 5};
  effect.parameters = Eigen::VectorXd::Zero(6);
  const double scale = FindEffectKind("leg_gain")->ScaleOf(0);
  EXPECT_DOUBLE_EQ(FreeEffect(effect, 3.0).prior_sigma[0], 3.0 * scale);
  effect.parameters[1] = 0.5 * scale, effect.parameters[4] = -0.5 * scale;
  EXPECT_DOUBLE_EQ(FreeEffect(effect, 3.0).prior_sigma[0], 3.0 * scale);
  effect.parameters[1] = 6.0 * scale, effect.parameters[4] = -8.0 * scale;
  const GrownEffect grown = FreeEffect(effect, 3.0);
  ASSERT_EQ(grown.prior_sigma.size(), 2);
  EXPECT_DOUBLE_EQ(grown.prior_sigma[1], 3.0 * std::sqrt(50.0) * scale);
  EXPECT_EQ(grown.prior_mean[1], 0.0);
}

class EveryEffect : public ::testing::TestWithParam<std::string> {};

TEST_P(EveryEffect, IsRecoveredFromWhatItDoes) {
  std::mt19937_64 rng = SeededByTest();
  const EffectKind& kind = *FindEffectKind(GetParam());
  const Dataset plan = Plan(rng, kind.name == "tracker_warmup");
  Machine machine = TrueMachine(rng);
  const std::vector<Visit> visits = MakeVisits(plan, &*plan.hexapod, ReportedPoses(plan));
  machine.effects = {testing::SomeEffect(rng, kind, visits, plan, 1.0)};
  const Scene scene(Simulate(plan, machine, {1, 0.0}));
  const GrownEffect grown = WithoutPriors(machine.effects[0], kind);
  const GrownProblem problem(scene.Data(), {grown});
  const GrownFit fit = FitGrown(problem, Near(machine), {StartNear(grown, kind)}, {});
  ASSERT_TRUE(fit.converged) << fit.message;
  EXPECT_LT(fit.chi_square + fit.misfit_chi_square, 1e-6);
  ExpectMounts(fit.mounts, machine, 1e-8);
  for (const int number : grown.free) {
    const double truth = machine.effects[0].parameters[number];
    EXPECT_NEAR(fit.effects[0].parameters[number], truth, 1e-6 * std::abs(truth)) << number;
    EXPECT_GT(fit.effects[0].standard_deviation[number], 0.0) << number;
  }
}

std::vector<std::string> NamesOfAll() {
  std::vector<std::string> names;
  for (const EffectKind& kind : EffectKinds())
    if (!kind.IsFault()) names.emplace_back(kind.name);
  return names;
}
INSTANTIATE_TEST_SUITE_P(Kinds,
                         EveryEffect,
                         ::testing::ValuesIn(NamesOfAll()),
                         [](const auto& param_info) { return param_info.param; });

Effect ZeroOf(const std::string& name, const Scene& scene, const std::vector<int>& index) {
  const EffectKind& kind = *FindEffectKind(name);
  Effect effect;
  effect.name = name;
  effect.index = index;
  effect.parameters = Eigen::VectorXd::Zero(kind.SizeFor(index));
  effect.reference = ReferenceFor(kind, scene.visits, scene.dataset);
  return effect;
}

TEST(GrownProblem, JacobianIsThatOfDifferences) {
  std::mt19937_64 rng = SeededByTest();
  const Machine machine = TrueMachine(rng);
  const Scene scene(Simulate(Plan(rng, false), machine, {1, 1.0}));
  const std::vector<GrownEffect> effects = {FreeEffect(ZeroOf("leg_gain", scene, {2, 5}), 3.0),
                                            FreeEffect(ZeroOf("tracker_scale", scene, {}), 3.0),
                                            FreeEffect(ZeroOf("tool_drift", scene, {}), 3.0),
                                            FreeEffect(ZeroOf("marker_offset", scene, {6}), 3.0)};
  const GrownProblem problem(scene.Data(), effects);
  ASSERT_EQ(problem.num_free(), 2 + 1 + 6 + 3);
  const Mounts at = Near(machine);
  const Eigen::VectorXd free = 1e-4 * testing::Normal(rng, problem.num_free());
  const auto evaluation = problem.Evaluate(at, free, true);
  ASSERT_TRUE(evaluation);
  const Eigen::MatrixXd numeric = NumericJacobian(
      [&](const Eigen::VectorXd& d) -> Eigen::VectorXd {
        const Mounts moved = {Plus(at.world_from_base, Vector6d(d.head<6>())),
                              Plus(at.platform_from_tool, Vector6d(d.segment<6>(6)))};
        return problem.Evaluate(moved, free + d.tail(problem.num_free()), false)->residual;
      },
      12 + problem.num_free(),
      1e-6);
  EXPECT_TRUE(JacobianNear(evaluation->jacobian, numeric, 2e-5));
}

TEST(GrownFit, WithoutEffectsIsThePlainCalibration) {
  std::mt19937_64 rng = SeededByTest();
  const Machine machine = TrueMachine(rng);
  const Scene scene(Simulate(Plan(rng, false), machine, {1, 1.0}));
  const GrownFit fit = FitGrown(GrownProblem(scene.Data(), {}), Near(machine), {}, {});
  const Estimate plain = Calibrate(MakeObservations(scene.dataset), std::nullopt, {});
  ASSERT_TRUE(fit.converged && plain.converged);
  EXPECT_TRUE(
      testing::PoseNear(fit.mounts.world_from_base, plain.mounts.world_from_base, 1e-10, 1e-10));
  EXPECT_TRUE(testing::PoseNear(
      fit.mounts.platform_from_tool, plain.mounts.platform_from_tool, 1e-10, 1e-10));
  EXPECT_NEAR(fit.chi_square, plain.chi_square, 1e-6 * plain.chi_square);
  EXPECT_TRUE(MatrixNear(fit.covariance / plain.covariance_unscaled.norm(),
                         plain.covariance_unscaled / plain.covariance_unscaled.norm(),
                         1e-6));
}

TEST(GrownFit, PullsAParameterThatDataDoNotTellToItsPrior) {
  std::mt19937_64 rng = SeededByTest();
  const Machine machine = TrueMachine(rng);
  const Scene scene(Simulate(Plan(rng, false), machine, {1, 1.0}));
  GrownEffect joints = FreeEffect(ZeroOf("base_joint_offset", scene, {}), 1.0);
  const GrownFit held = FitGrown(GrownProblem(scene.Data(), {joints}), Near(machine), {}, {});
  ASSERT_TRUE(held.converged);
  EXPECT_TRUE(
      std::all_of(held.determined.begin(), held.determined.end(), [](bool d) { return d; }));
  for (const double sigma : held.effects[0].standard_deviation) EXPECT_LT(sigma, 1.01e-4);
  joints.prior_sigma.setConstant(std::numeric_limits<double>::infinity());
  const GrownFit loose = FitGrown(GrownProblem(scene.Data(), {joints}), Near(machine), {}, {});
  EXPECT_TRUE(std::count(loose.determined.begin(), loose.determined.end(), false) > 0);
  EXPECT_TRUE(loose.effects[0].standard_deviation.array().isNaN().any());
}

TEST(GrownFit, TakesTheBestOfItsStarts) {
  std::mt19937_64 rng = SeededByTest();
  Machine machine = TrueMachine(rng);
  const Dataset plan = Plan(rng, false);
  const std::vector<Visit> visits = MakeVisits(plan, &*plan.hexapod, ReportedPoses(plan));
  Effect truth = testing::SomeEffect(rng, *FindEffectKind("leg_periodic"), visits, plan, 3.0);
  machine.effects = {truth};
  const Scene scene(Simulate(plan, machine, {1, 0.0}));
  const GrownEffect grown = WithoutPriors(truth, *FindEffectKind("leg_periodic"));
  const GrownProblem problem(scene.Data(), {grown});
  Eigen::VectorXd wrong = problem.Start();
  const auto period = std::find(grown.free.begin(), grown.free.end(), 12) - grown.free.begin();
  wrong[period] *= 1.4;
  const GrownFit fit = FitGrown(problem, Near(machine), {wrong, problem.Start(), wrong}, {});
  EXPECT_EQ(fit.start, 1);
  EXPECT_LT(fit.chi_square, 1e-6);
}

// The standard deviations against what repeated noise does to the parameter.
void ExpectScatter(const std::string& name, std::mt19937_64& rng) {
  constexpr int kDraws = 100;
  const EffectKind& kind = *FindEffectKind(name);
  const Dataset plan = Plan(rng, false);
  Machine machine = TrueMachine(rng);
  const std::vector<Visit> visits = MakeVisits(plan, &*plan.hexapod, ReportedPoses(plan));
  machine.effects = {testing::SomeEffect(rng, kind, visits, plan, 1.0)};
  const GrownEffect grown = WithoutPriors(machine.effects[0], kind);
  double sum = 0.0;
  int count = 0;
  for (int draw = 0; draw < kDraws; ++draw) {
    const Scene scene(Simulate(plan, machine, {static_cast<std::uint64_t>(draw + 1), 1.0}));
    const GrownFit fit = FitGrown(GrownProblem(scene.Data(), {grown}),
                                  {machine.world_from_base, machine.platform_from_tool},
                                  {},
                                  {});
    ASSERT_TRUE(fit.converged);
    for (const int number : grown.free) {
      const double off = fit.effects[0].parameters[number] - machine.effects[0].parameters[number];
      const double z = off / fit.effects[0].standard_deviation[number];
      sum += z * z;
      ++count;
    }
  }
  // One number's mean square strays by sqrt(2 / 100) = 0.141.
  EXPECT_NEAR(sum / count, 1.0, 0.35) << name;
}

TEST(GrownFit, StandardDeviationsAreTheScatterOfALegsParameters) {
  std::mt19937_64 rng = SeededByTest();
  ExpectScatter("leg_backlash", rng);
}

TEST(GrownFit, StandardDeviationsAreTheScatterOfTheTrackersParameters) {
  std::mt19937_64 rng = SeededByTest();
  ExpectScatter("tracker_scale", rng);
}

}  // namespace
}  // namespace hexcal
