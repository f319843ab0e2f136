// SPDX-License-Identifier: BSD-3-Clause
#include "model/simulate.h"

#include <fmt/format.h>

#include <random>

#include "model/data_fault.h"
#include "model/hexapod.h"
#include "model/machine_rows.h"
#include "model/predict.h"

namespace hexcal {
namespace {

// SplitMix64 (Steele, Lea, Flood, OOPSLA 2014): any state is a good seed.
class QuickGenerator {
 public:
  using result_type = std::uint64_t;
  static constexpr result_type min() { return 0; }
  static constexpr result_type max() { return ~result_type{0}; }

  QuickGenerator(std::uint64_t seed, const std::string& label) : state_(seed) {
    for (const char c : label) state_ = (*this)() ^ static_cast<unsigned char>(c);
  }

  result_type operator()() {
    result_type z = (state_ += 0x9e3779b97f4a7c15);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return z ^ (z >> 31);
  }

 private:
  std::uint64_t state_;
};

// Standard normal draws that belong to one pose, whatever other poses there are and in which order.
class PoseDraws {
 public:
  PoseDraws(const SimulateOptions& options, const std::string& label) : factor_(options.noise) {
    if (options.quick) {
      quick_.emplace(options.seed, label);
      return;
    }
    std::vector<std::uint32_t> words = {static_cast<std::uint32_t>(options.seed),
                                        static_cast<std::uint32_t>(options.seed >> 32)};
    for (const char c : label) words.push_back(static_cast<unsigned char>(c));
    std::seed_seq seed(words.begin(), words.end());
    generator_.emplace(seed);
  }

  template <int kSize>
  Eigen::Matrix<double, kSize, 1> Draw() {
    Eigen::Matrix<double, kSize, 1> draws;
    for (int i = 0; i < kSize; ++i)
      draws[i] = factor_ * (quick_ ? normal_(*quick_) : normal_(*generator_));
    return draws;
  }

 private:
  double factor_;
  std::optional<QuickGenerator> quick_;
  std::optional<std::mt19937_64> generator_;
  std::normal_distribution<double> normal_;
};

Vector6d Sigma(const PoseNoise& noise) {
  Vector6d sigma;
  sigma << noise.position, noise.orientation;
  return sigma;
}

const Measurement& MeasurementOf(const Dataset& dataset) {
  if (dataset.measurement) return *dataset.measurement;
  throw InputError(FileLocation(dataset.path),
                   "no measurement",
                   "measurement: with its kind and noise, and for markers the two bodies: a "
                   "simulation imitates it");
}

void RefuseCentroidBodies(const Measurement& measurement) {
  for (const BodyId id : {BodyId::kBase, BodyId::kTool})
    if (measurement.bodies[static_cast<int>(id)].is_centroid)
      throw InputError(
          measurement.where,
          fmt::format("the {} body with frame: centroid", id == BodyId::kBase ? "base" : "tool"),
          "frame: rigid with the markers' coordinates, to know where they are");
}

// What a simulation is made of, resolved once for all poses.
struct Scene {
  const Dataset& dataset;
  const Machine& machine;
  const HexapodGeometry* hexapod;  // the machine's, else the dataset's; null: none
  Pose3d tracker_from_world;
  std::vector<int> marker_as_read;  // MarkersAsRead
};

Pose3d TrackerFromWorld(const Dataset& dataset, const Machine& machine) {
  if (dataset.tracker.tracker_from_world) return *dataset.tracker.tracker_from_world;
  if (machine.world_from_tracker) return machine.world_from_tracker->Inverse();
  return {};
}

// Where the platform stands when the controller reports base_from_platform.
Pose3d TruePlatform(const Scene& scene,
                    const RobotPose& row,
                    const Pose3d& base_from_platform,
                    PoseDraws* draws) {
  const RobotPoses& robot_poses = scene.dataset.robot_poses;
  const Vector6d draw = draws->Draw<6>();
  if (robot_poses.noise)
    return Plus(base_from_platform, Vector6d(Sigma(*robot_poses.noise).cwiseProduct(draw)));
  if (!robot_poses.leg_noise || scene.hexapod == nullptr) return base_from_platform;

  const LegLengths lengths =
      InverseKinematics(*scene.hexapod, base_from_platform) + *robot_poses.leg_noise * draw;
  const ForwardKinematicsResult result =
      ForwardKinematics(*scene.hexapod, lengths, base_from_platform);
  if (result.converged) return result.base_from_platform;
  Location where = robot_poses.where;
  where.line = row.line;
  where.column = 0;
  throw InputError(
      where,
      fmt::format(
          "the leg lengths of pose '{}', moved by drawn noise ({})", row.label, result.message),
      "poses and a leg noise that leave the platform in its workspace");
}

// The coordinates of a body's markers where they really are.
Eigen::Matrix3Xd TrueMarkers(const MarkerBody& body, const Eigen::Matrix3Xd& correction) {
  return correction.cols() == 0 ? body.p_in_body : Eigen::Matrix3Xd(body.p_in_body + correction);
}

void SeeMarkers(const Scene& scene,
                const MachineRows::Row& row,
                const Pose3d& world_from_tool,
                PoseDraws* draws,
                Measurement* measurement) {
  const std::array<Pose3d, 2> tracker_from_body = {scene.tracker_from_world,
                                                   scene.tracker_from_world * world_from_tool};
  const Eigen::Vector3d sigma = measurement->marker_sigma.value_or(Eigen::Vector3d::Zero());
  const int base_markers = static_cast<int>(measurement->bodies[0].markers.size());
  for (int frame = 0; frame < scene.dataset.tracker.frames; ++frame) {
    for (const int body : {0, 1}) {
      const Eigen::Matrix3Xd markers =
          TrueMarkers(measurement->bodies[body], row.corrections.markers[body]);
      for (int marker = 0; marker < markers.cols(); ++marker) {
        const Eigen::Vector3d p_in_body = markers.col(marker);
        const Eigen::Vector3d p_in_tracker =
            TrackerReading(row.corrections, tracker_from_body[body] * p_in_body) +
            sigma.cwiseProduct(draws->Draw<3>());
        const int name = scene.marker_as_read[body * base_markers + marker];
        const bool is_of_tool = name >= base_markers;
        measurement->readings.push_back({row.visit.row,
                                         frame,
                                         is_of_tool ? BodyId::kTool : BodyId::kBase,
                                         is_of_tool ? name - base_markers : name,
                                         p_in_tracker});
      }
    }
  }
}

void SeePose(const MachineRows::Row& row,
             const Pose3d& world_from_tool,
             PoseDraws* draws,
             Measurement* measurement) {
  const Vector6d sigma = Sigma(measurement->pose_noise.value_or(PoseNoise()));
  const Vector6d noise = sigma.cwiseProduct(draws->Draw<6>());
  const Pose3d reading = TrackerPoseReading(row.corrections, world_from_tool);
  measurement->poses.push_back({row.visit.row, Plus(reading, noise)});
}

std::vector<int> MarkerNames(const Measurement& measurement, const Machine& machine) {
  const int markers =
      static_cast<int>(measurement.bodies[0].markers.size() + measurement.bodies[1].markers.size());
  for (const Effect& effect : machine.effects)
    for (const int marker : effect.name == "swapped_markers" ? effect.index : std::vector<int>())
      if (marker > markers)
        throw InputError(measurement.where,
                         fmt::format("{} markers", markers),
                         fmt::format("the marker {} that the model says is swapped", marker));
  return MarkersAsRead(machine.effects, markers);
}

// The measurement's description without what was measured.
Measurement Emptied(const Measurement& from, int frames) {
  Measurement measurement = from;
  measurement.poses.clear();
  measurement.readings.clear();
  measurement.frame_labels.clear();
  if (measurement.kind == Measurement::Kind::kMarkers && frames > 1)
    for (int frame = 1; frame <= frames; ++frame)
      measurement.frame_labels.push_back(fmt::format("{}", frame));
  return measurement;
}

}  // namespace

Dataset Simulate(const Dataset& dataset, const Machine& machine, const SimulateOptions& options) {
  Measurement measurement = Emptied(MeasurementOf(dataset), dataset.tracker.frames);
  const bool sees_markers = measurement.kind == Measurement::Kind::kMarkers;
  if (sees_markers) RefuseCentroidBodies(measurement);

  const Scene scene = {dataset,
                       machine,
                       HexapodOf(dataset, machine),
                       TrackerFromWorld(dataset, machine),
                       MarkerNames(measurement, machine)};
  const std::vector<Pose3d> reported = ReportedPoses(dataset, machine);
  MachineRows rows(dataset, machine, reported, EffectSites::kAll);
  for (std::size_t i = 0; i < reported.size(); ++i) {
    const RobotPose& recorded = dataset.robot_poses.rows[i];
    PoseDraws draws(options, recorded.label);
    MachineRows::Row row = rows.Next();
    row.visit.base_from_platform = TruePlatform(scene, recorded, reported[i], &draws);
    const Pose3d world_from_tool = rows.Forward(row).world_from_tool;
    if (sees_markers)
      SeeMarkers(scene, row, world_from_tool, &draws, &measurement);
    else
      SeePose(row, world_from_tool, &draws, &measurement);
  }
  Dataset simulated = dataset;
  simulated.measurement = std::move(measurement);
  return simulated;
}

}  // namespace hexcal
