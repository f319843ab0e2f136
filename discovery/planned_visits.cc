// SPDX-License-Identifier: BSD-3-Clause
#include "discovery/planned_visits.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>

#include "measurement/marker_body.h"
#include "measurement/tool_pose.h"
#include "model/data_fault.h"
#include "model/described_effect.h"
#include "model/hexapod.h"
#include "model/machine_rows.h"
#include "model/predict.h"
#include "model/simulate.h"

namespace hexcal {
namespace {

constexpr double kOtherwise = 60.0;  // s between visits, where the dataset's times tell nothing

bool IsFault(const Effect& effect) { return FindFaultKind(effect.name) != nullptr; }

int TimeColumn(const Dataset& dataset) {
  const auto& covariates = dataset.robot_poses.covariates;
  for (std::size_t k = 0; k < covariates.size(); ++k)
    if (covariates[k].name == "time") return static_cast<int>(k);
  return -1;
}

// The last time and the usual time from one visit to the next, s.
std::pair<double, double> Pace(const std::vector<double>& times) {
  std::vector<double> steps;
  for (std::size_t k = 1; k < times.size(); ++k)
    if (times[k] > times[k - 1]) steps.push_back(times[k] - times[k - 1]);
  std::sort(steps.begin(), steps.end());
  return {*std::max_element(times.begin(), times.end()),
          steps.empty() ? kOtherwise : steps[steps.size() / 2]};
}

bool HasReadings(const Dataset& dataset) {
  return !dataset.measurement->readings.empty() || !dataset.measurement->poses.empty();
}

// Readings of one marker in one pose.
int FramesOf(const Dataset& dataset, int measured) {
  const Measurement& measurement = *dataset.measurement;
  const std::size_t markers =
      measurement.bodies[0].markers.size() + measurement.bodies[1].markers.size();
  if (measurement.readings.empty() || markers == 0 || measured == 0) return dataset.tracker.frames;
  const double each =
      static_cast<double>(measurement.readings.size()) / (static_cast<double>(markers) * measured);
  return std::max(1, static_cast<int>(std::lround(each)));
}

// The shape of a body whose coordinates nobody knows, from the first pose that shows all of it.
void FindShape(const Measurement& measurement, int b, MarkerBody* body) {
  std::map<int, Eigen::Matrix3d> seen;
  std::map<int, std::set<int>> markers;
  for (const MarkerReading& reading : measurement.readings) {
    if (static_cast<int>(reading.body) != b) continue;
    seen[reading.pose].col(reading.marker) = reading.p_in_tracker;
    markers[reading.pose].insert(reading.marker);
  }
  for (const auto& [pose, which] : markers) {
    if (which.size() < 3) continue;
    const Pose3d tracker_from_body =
        CentroidFrame(seen[pose], Eigen::Matrix3d::Ones(), body->x_axis).a_from_b;
    body->p_in_body.resize(3, 3);
    for (int m = 0; m < 3; ++m)
      body->p_in_body.col(m) = tracker_from_body.Inverse() * Eigen::Vector3d(seen[pose].col(m));
    body->is_centroid = false;
    return;
  }
}

// Where the tracker stood, as far as the readings tell.
std::optional<Pose3d> TrackerFromWorld(const Dataset& dataset) {
  if (dataset.measurement->readings.empty()) return std::nullopt;
  const ToolPoses tool_poses = ComputeToolPoses(dataset);
  if (tool_poses.tracker_from_world) return tool_poses.tracker_from_world;
  const std::vector<SeenPose> seen = SeePoses(dataset, tool_poses, {});
  const SeenBody& base = seen[seen.size() / 2].bodies[0];
  if (base.markers.empty()) return std::nullopt;
  return base.tracker_from_body;
}

// The dataset with other rows, as a simulation sees them.
Dataset Simulated(const PlanScene& scene, const RobotPoses& rows) {
  Dataset dataset = scene.dataset;
  dataset.robot_poses = rows;
  dataset.tracker.frames = FramesOf(scene.dataset, scene.measured);
  if (const auto tracker = TrackerFromWorld(scene.dataset))
    dataset.tracker.tracker_from_world = tracker;
  for (int b = 0; b < 2; ++b)
    if (dataset.measurement->bodies[b].is_centroid)
      FindShape(*scene.dataset.measurement, b, &dataset.measurement->bodies[b]);
  SimulateOptions exact;
  exact.noise = 0.0;
  return Simulate(dataset, scene.machine, exact);
}

}  // namespace

PlanScene MakePlanScene(const Dataset& dataset, const Machine& machine) {
  if (!dataset.measurement)
    throw InputError(FileLocation(dataset.path),
                     "no measurement",
                     "measurement: with its kind, and for markers the two bodies: a plan is for "
                     "more of it");
  PlanScene scene;
  scene.dataset = dataset;
  scene.reported = ReportedPoses(dataset, machine);
  MachineRows(dataset, machine, scene.reported, EffectSites::kAll);
  const HexapodGeometry* hexapod = HexapodOf(dataset, machine);
  scene.dataset.robot_poses = MendedRobotPoses(dataset.robot_poses, machine.effects, hexapod);
  scene.machine = machine;
  if (hexapod != nullptr) {
    // More rows must not move the centre of the travel.
    scene.dataset.hexapod = *hexapod;
    scene.dataset.hexapod->home = HomePose(hexapod, scene.reported);
    scene.machine.hexapod = scene.dataset.hexapod;
  }
  std::vector<Effect>& effects = scene.machine.effects;
  effects.erase(std::remove_if(effects.begin(), effects.end(), IsFault), effects.end());
  scene.effects = effects;
  if (machine.pose_map) scene.effects.push_back(PoseMapEffect(*machine.pose_map));
  if (HasReadings(dataset))
    scene.measured = static_cast<int>(ComputeToolPoses(scene.dataset).poses.size());
  return scene;
}

PlannedVisits MakeVisitPool(const PlanScene& scene,
                            const std::vector<Pose3d>& poses,
                            int count,
                            int settings,
                            const ChosenSettings& chosen,
                            std::uint64_t seed) {
  std::mt19937_64 generator(seed);
  const std::vector<CovariateGroup> groups = CovariateSettings(scene.dataset, chosen);
  std::size_t combinations = 1;
  for (const CovariateGroup& group : groups) combinations *= group.settings.size();
  const int each = static_cast<int>(std::min<std::size_t>(combinations, settings));
  const int time = TimeColumn(scene.dataset);
  const auto& covariates = scene.dataset.robot_poses.covariates;
  PlannedVisits visits;
  for (const Pose3d& pose : poses)
    for (int k = 0; k < each; ++k) {
      std::vector<double> values(covariates.size(), 0.0);
      for (const CovariateGroup& group : groups) {
        const auto& setting = group.settings[generator() % group.settings.size()];
        for (std::size_t c = 0; c < setting.size(); ++c) values[group.columns[c]] = setting[c];
      }
      if (time >= 0) {
        const auto [last, step] = Pace(covariates[time].values);
        values[time] = last + 0.5 * (count + 1) * step;
      }
      visits.base_from_platform.push_back(pose);
      visits.covariates.push_back(std::move(values));
    }
  return visits;
}

PlannedVisits InTime(const PlanScene& scene, PlannedVisits visits) {
  const int time = TimeColumn(scene.dataset);
  if (time < 0) return visits;
  const auto [last, step] = Pace(scene.dataset.robot_poses.covariates[time].values);
  for (std::size_t k = 0; k < visits.covariates.size(); ++k)
    visits.covariates[k][time] = last + static_cast<double>(k + 1) * step;
  return visits;
}

RobotPoses RobotPosesOf(const PlanScene& scene, const PlannedVisits& visits) {
  RobotPoses poses = scene.dataset.robot_poses;
  std::set<std::string> taken;
  for (const RobotPose& row : poses.rows) taken.insert(row.label);
  poses.rows.clear();
  for (Covariate& covariate : poses.covariates) covariate.values.clear();
  int number = 0;
  for (std::size_t k = 0; k < visits.base_from_platform.size(); ++k) {
    RobotPose row;
    do row.label = fmt::format("plan-{}", ++number);
    while (taken.count(row.label) > 0);
    row.base_from_platform = visits.base_from_platform[k];
    row.leg_lengths = {};
    if (poses.are_leg_lengths) {
      const LegLengths lengths = InverseKinematics(*scene.dataset.hexapod, row.base_from_platform);
      std::copy(lengths.begin(), lengths.end(), row.leg_lengths.begin());
    }
    for (std::size_t c = 0; c < poses.covariates.size(); ++c)
      poses.covariates[c].values.push_back(visits.covariates[k][c]);
    poses.rows.push_back(std::move(row));
  }
  return poses;
}

Dataset WithVisits(const PlanScene& scene, const PlannedVisits& visits) {
  Dataset all = scene.dataset;
  const RobotPoses planned = RobotPosesOf(scene, visits);
  const Dataset simulated = Simulated(scene, planned);
  const int offset = static_cast<int>(all.robot_poses.rows.size());
  all.robot_poses.rows.insert(all.robot_poses.rows.end(), planned.rows.begin(), planned.rows.end());
  for (std::size_t c = 0; c < planned.covariates.size(); ++c) {
    std::vector<double>& values = all.robot_poses.covariates[c].values;
    values.insert(
        values.end(), planned.covariates[c].values.begin(), planned.covariates[c].values.end());
  }
  for (MeasuredPose pose : simulated.measurement->poses) {
    pose.pose += offset;
    all.measurement->poses.push_back(pose);
  }
  for (MarkerReading reading : simulated.measurement->readings) {
    reading.pose += offset;
    all.measurement->readings.push_back(reading);
  }
  return all;
}

GapData GapDataOf(const PlanScene& scene,
                  const PlannedVisits& visits,
                  const Dataset& with_visits,
                  bool is_pool,
                  int count) {
  std::vector<Pose3d> reported = scene.reported;
  reported.insert(
      reported.end(), visits.base_from_platform.begin(), visits.base_from_platform.end());
  GapData data = MakeGapData(with_visits, reported);
  if (is_pool)
    for (std::size_t row = scene.reported.size(); row < data.visits.size(); ++row)
      data.visits[row].row = static_cast<int>(scene.reported.size()) + count / 2;
  return data;
}

}  // namespace hexcal
