// SPDX-License-Identifier: BSD-3-Clause
// What planned poses are worth beside as many random ones from the same pool: tables of
// docs/plan.md.
//   plan_study [--draws=15] [--seed=1]
#include <fmt/format.h>
#include <gflags/gflags.h>
#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "discovery/plan.h"
#include "discovery/planned_visits.h"
#include "discovery/pose_pool.h"
#include "model/simulate.h"
#include "testing/hexapods.h"

DEFINE_int32(draws, 15, "random choices for each row");
DEFINE_int32(seed, 1, "of everything");

namespace hexcal {
namespace {

using testing::SmallPose;
using testing::Uniform;

constexpr int kMeasured = 40, kPlanned = 12;

struct MachineKind {
  const char* name;
  HexapodGeometry hexapod;
  double height, half_width, half_angle;  // of the measured poses
  Eigen::Vector2d leg_limits;
};

std::vector<MachineKind> Machines() {
  return {{"desk-top",
           testing::SmallHexapod(),
           testing::kSmallHeight,
           0.008,
           0.06,
           Eigen::Vector2d(0.23, 0.31)},
          {"large",
           testing::LargeHexapod(),
           testing::kLargeHeight,
           0.03,
           0.1,
           Eigen::Vector2d(0.4, 0.75)}};
}

// Poses in the middle of the travel, temperature that rises with time, two loads in turn; four
// markers a body.
Dataset MakeDataset(std::mt19937_64& rng, const MachineKind& machine, bool by_markers) {
  Dataset dataset;
  dataset.path = "study.yaml";
  dataset.name = "study";
  dataset.hexapod = machine.hexapod;
  dataset.hexapod->leg_limits = machine.leg_limits;
  dataset.gravity_in_base = Eigen::Vector3d(0, 0, -1);
  std::vector<Covariate> columns = {{"time", {}, {}}, {"temperature", {}, {}}, {"payload", {}, {}}};
  for (int i = 0; i < kMeasured; ++i) {
    Pose3d pose = SmallPose(rng, machine.half_width, machine.half_angle);
    pose.translation.z() += machine.height;
    dataset.robot_poses.rows.push_back({std::to_string(i + 1), pose, {}, i + 2});
    columns[0].values.push_back(60.0 * i);
    columns[1].values.push_back(20.0 + 0.1 * i + Uniform(rng, -0.2, 0.2));
    columns[2].values.push_back(i % 2 == 0 ? 0.0 : 5.0);
  }
  dataset.robot_poses.covariates = columns;
  dataset.tracker.tracker_from_world = {{0.2, 0.1, 2.0}, Exp(Eigen::Vector3d(2.8, 0.3, 0.2))};
  Measurement& measurement = dataset.measurement.emplace();
  if (!by_markers) {
    measurement.kind = Measurement::Kind::kPoses;
    measurement.pose_noise =
        PoseNoise{Eigen::Vector3d::Constant(2e-5), Eigen::Vector3d::Constant(1e-4)};
    return dataset;
  }
  measurement.kind = Measurement::Kind::kMarkers;
  measurement.marker_sigma = Eigen::Vector3d(3e-5, 3e-5, 6e-5);
  measurement.bodies[0].markers = {"b1", "b2", "b3", "b4"};
  measurement.bodies[0].p_in_body.resize(3, 4);
  measurement.bodies[0].p_in_body << 0.4, -0.4, -0.4, 0.4, 0.3, 0.3, -0.3, -0.3, 0, 0.05, 0, 0.08;
  measurement.bodies[1].markers = {"t1", "t2", "t3", "t4"};
  measurement.bodies[1].p_in_body.resize(3, 4);
  measurement.bodies[1].p_in_body << 0.1, -0.1, -0.1, 0.1, 0.1, 0.1, -0.1, -0.1, 0, 0.03, 0, 0.05;
  return dataset;
}

// An effect of `sizes` plausible ones; of leg 3 alone where one leg carries it.
Effect MakeEffect(const std::string& name, bool is_one_leg, double sizes, const Dataset& dataset) {
  const EffectKind& kind = *FindEffectKind(name);
  std::vector<Pose3d> reported;
  for (const RobotPose& row : dataset.robot_poses.rows) reported.push_back(row.base_from_platform);
  Effect effect;
  effect.name = name;
  if (is_one_leg) effect.index = {3};
  effect.parameters.setZero(kind.SizeFor(effect.index));
  for (int k = 0; k < effect.parameters.size(); ++k)
    if (!kind.ParameterOf(k).is_search && (!is_one_leg || k == 2))
      effect.parameters[k] = sizes * kind.ScaleOf(k);
  effect.reference = ReferenceFor(kind, MakeVisits(dataset, &*dataset.hexapod, reported), dataset);
  return effect;
}

Dataset Measured(Dataset dataset, const RobotPoses* more, const Machine& truth) {
  RobotPoses& poses = dataset.robot_poses;
  if (more != nullptr) {
    poses.rows.insert(poses.rows.end(), more->rows.begin(), more->rows.end());
    for (std::size_t c = 0; c < poses.covariates.size(); ++c)
      poses.covariates[c].values.insert(poses.covariates[c].values.end(),
                                        more->covariates[c].values.begin(),
                                        more->covariates[c].values.end());
  }
  return Simulate(dataset, truth, {});
}

// As many random visits of the pool that a plan chooses from.
RobotPoses RandomVisits(const Dataset& measured, const Machine& truth, std::mt19937_64& rng) {
  const PlanScene scene = MakePlanScene(measured, truth);
  const Reach reach = ReachOf(&*scene.dataset.hexapod, scene.reported);
  const PlannedVisits pool =
      MakeVisitPool(scene, MakePosePool(reach, 300, FLAGS_seed), kPlanned, 3, {}, FLAGS_seed);
  PlannedVisits some;
  for (int k = 0; k < kPlanned; ++k) {
    const std::size_t at = rng() % pool.base_from_platform.size();
    some.base_from_platform.push_back(pool.base_from_platform[at]);
    some.covariates.push_back(pool.covariates[at]);
  }
  return RobotPosesOf(scene, InTime(scene, some));
}

// What a plan of one pose says of the poses measured so far.
Plan Judged(const Dataset& measured, const Machine& truth, PlanGoal goal) {
  PlanOptions options;
  options.goal = goal;
  options.poses = 1;
  options.pool = 50;
  return MakePlan(measured, truth, options);
}

double Median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

// Geometric mean of the 12.
double MeanOf(const Vector12d& deviation) { return std::exp(deviation.array().log().mean()); }

void StudyParameters() {
  fmt::print(
      "| machine | measured | random (median, best) | planned |\n| --- | --- | --- | --- |\n");
  for (const MachineKind& machine : Machines())
    for (const bool by_markers : {false, true}) {
      std::mt19937_64 rng(FLAGS_seed);
      Machine truth;
      truth.world_from_base = SmallPose(rng, 0.3, 1.0);
      truth.platform_from_tool = SmallPose(rng, 0.05, 0.5);
      const Dataset dataset = MakeDataset(rng, machine, by_markers);
      const Dataset before = Measured(dataset, nullptr, truth);
      PlanOptions options;
      options.goal = PlanGoal::kParameters;
      options.poses = kPlanned;
      const Plan plan = MakePlan(before, truth, options);
      const double now = MeanOf(plan.deviation_before);
      std::vector<double> random;
      for (int draw = 0; draw < FLAGS_draws; ++draw) {
        const RobotPoses visits = RandomVisits(before, truth, rng);
        const Dataset after = Measured(dataset, &visits, truth);
        random.push_back(MeanOf(Judged(after, truth, PlanGoal::kParameters).deviation_before) /
                         now);
      }
      fmt::print("| {}, {} | 1 | {:.3f}, {:.3f} | {:.3f} |\n",
                 machine.name,
                 by_markers ? "markers" : "poses",
                 Median(random),
                 *std::min_element(random.begin(), random.end()),
                 MeanOf(plan.deviation_after) / now);
    }
}

struct PairKind {
  const char *effect, *rival;
  bool is_one_leg, by_markers;
  double sizes;  // small enough that the rivals are left
};

const RivalPair* PairOf(const Plan& plan, const std::string& rival) {
  for (const RivalPair& pair : plan.pairs)
    if (pair.rival == rival) return &pair;
  return nullptr;
}

void StudyPair(const MachineKind& machine, const PairKind& kind) {
  std::mt19937_64 rng(FLAGS_seed);
  Machine truth;
  truth.world_from_base = SmallPose(rng, 0.3, 1.0);
  truth.platform_from_tool = SmallPose(rng, 0.05, 0.5);
  const Dataset dataset = MakeDataset(rng, machine, kind.by_markers);
  truth.effects = {MakeEffect(kind.effect, kind.is_one_leg, kind.sizes, dataset)};
  const Dataset before = Measured(dataset, nullptr, truth);
  PlanOptions options;
  options.goal = PlanGoal::kRivals;
  options.poses = kPlanned;
  const Plan plan = MakePlan(before, truth, options);
  const RivalPair* pair = PairOf(plan, kind.rival);
  if (pair == nullptr) {
    fmt::print("| {}: {}, {} | told apart by the measured poses | | | |\n",
               machine.name,
               kind.effect,
               kind.rival);
    return;
  }
  std::vector<double> random;
  for (int draw = 0; draw < FLAGS_draws; ++draw) {
    const RobotPoses visits = RandomVisits(before, truth, rng);
    const Plan judged = Judged(Measured(dataset, &visits, truth), truth, PlanGoal::kRivals);
    if (const RivalPair* found = PairOf(judged, kind.rival))
      random.push_back(found->before * found->before);
  }
  fmt::print("| {}: {}{}, {} | {:.2g} | {} ({} of {}) | {:.2g} | {} |\n",
             machine.name,
             kind.effect,
             kind.is_one_leg ? " (one leg)" : "",
             kind.rival,
             pair->before * pair->before,
             random.empty() ? "-" : fmt::format("{:.2g}", Median(random)),
             random.size(),
             FLAGS_draws,
             pair->after * pair->after,
             NameOf(pair->separation));
}

void StudyRivals() {
  fmt::print(
      "\n| machine: effect, rival | measured | random (median) | planned | separable |\n"
      "| --- | --- | --- | --- | --- |\n");
  const PairKind pairs[] = {{"leg_offset", "base_joint_offset", true, false, 1.0},
                            {"leg_offset", "base_radius", false, false, 0.3},
                            {"joint_axis_offset", "base_radius", false, false, 1.0},
                            {"base_radius", "base_joint_offset", false, false, 1.0},
                            {"leg_compliance", "base_flexure", false, false, 0.5},
                            {"tool_sag", "leg_compliance", false, false, 1.0},
                            {"leg_thermal", "base_drift", false, false, 1.0},
                            {"tracker_scale", "tracker_depth_scale", false, true, 0.05}};
  for (const MachineKind& machine : Machines())
    for (const PairKind& kind : pairs) StudyPair(machine, kind);
}

}  // namespace
}  // namespace hexcal

int main(int argc, char** argv) {
  google::InitGoogleLogging(argv[0]);
  gflags::ParseCommandLineFlags(&argc, &argv, true);
  hexcal::StudyParameters();
  hexcal::StudyRivals();
}
