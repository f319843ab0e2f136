// SPDX-License-Identifier: BSD-3-Clause
#include "measurement/importers/assemble.h"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_set>

#include "config/units.h"
#include "geometry/quaternion_order.h"
#include "measurement/importers/body_shape.h"
#include "measurement/importers/pairing.h"
#include "measurement/importers/repeated_rows.h"
#include "measurement/importers/tracked_side.h"
#include "measurement/labels.h"

namespace hexcal {
namespace {

constexpr double kSecond = 1e9;  // ns
constexpr const char* kMarkerPrefix[] = {"b", "t"};

using Sides = std::vector<std::array<TrackedSide, 2>>;  // by file of the tracker, by BodyId
using Pairs = std::vector<std::vector<TrackerRow>>;     // by row of the robot

const RecordedBody& RobotBody(const Recording& robot) {
  if (robot.bodies.size() == 1 && !robot.bodies.front().poses.empty()) return robot.bodies.front();
  throw InputError(
      FileLocation(robot.path),
      fmt::format("{} bodies and {} markers", robot.bodies.size(), robot.markers.size()),
      "the poses of one robot");
}

RobotPoses MakeRobotPoses(const Recording& robot, const AssembleOptions& options) {
  const RecordedBody& body = RobotBody(robot);
  RobotPoses poses;
  poses.where = FileLocation(robot.path);
  std::unordered_set<std::string> labels;
  for (std::size_t i = 0; i < robot.rows; ++i) {
    const int line = robot.lines.empty() ? 0 : robot.lines[i];
    if (!body.poses[i])
      throw InputError({poses.where.file, line, 0}, "no pose of the robot", "one in every row");
    const std::string label =
        robot.labels.empty() ? std::to_string(i + 1) : CleanLabel(robot.labels[i]);
    if (!labels.insert(label).second)
      throw InputError({poses.where.file, line, 0},
                       fmt::format("the label {} a second time", Quoted(label)),
                       "each once");
    const Pose3d& pose = *body.poses[i];
    CheckPlace(robot, i, body.name, pose.translation);
    poses.rows.push_back({label, options.robot_inverse ? pose.Inverse() : pose, {}, line});
  }
  return poses;
}

// s since the first, where the times of all poses are known; by the tracker's clock.
void AddTimes(const Recording& robot,
              const std::vector<Recording>& tracker,
              const Pairs& pairs,
              const AssembleOptions& options,
              RobotPoses& poses) {
  const bool by_robot = options.pairing == Pairing::kTime;
  std::vector<std::int64_t> times;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (by_robot) {
      times.push_back(robot.times[i]);
    } else {
      if (pairs[i].empty()) return;
      const TrackerRow& first = pairs[i].front();
      const Recording& recording = tracker[first.file];
      if (recording.times.size() != recording.rows) return;
      times.push_back(recording.times[first.row]);
    }
  }
  const std::int64_t start = *std::min_element(times.begin(), times.end());
  Covariate time{"time", *FindCovariateUnit("s"), {}};
  for (const std::int64_t t : times)
    time.values.push_back(static_cast<double>(t - start) / kSecond);
  poses.covariates.push_back(std::move(time));
}

// By markers where the shapes of both bodies are to be had, else by poses.
Measurement::Kind ChooseKind(const Recording& first,
                             const std::array<TrackedSide, 2>& sides,
                             const AssembleOptions& options) {
  const bool markers =
      HasShape(sides[0], options.base_shape) && HasShape(sides[1], options.tool_shape);
  const bool poses = (sides[0].is_tracker || sides[0].body != nullptr) && sides[1].body != nullptr;
  if (options.kind == ImportKind::kMarkers ? markers : markers && options.kind == ImportKind::kAny)
    return Measurement::Kind::kMarkers;
  if (poses && options.kind != ImportKind::kMarkers) return Measurement::Kind::kPoses;
  std::string found;
  for (const TrackedSide& side : sides)
    found += fmt::format("{}{} {}, {} markers",
                         found.empty() ? "" : "; ",
                         side.is_tracker ? "the tracker as base" : Quoted(side.name),
                         side.body != nullptr ? "with poses" : "without poses",
                         side.markers.size());
  throw InputError(FileLocation(first.path),
                   found,
                   "for poses: a pose of the tool, and of the base unless it is the tracker; for "
                   "markers: at least 3 of each of two bodies, whose shapes are known by "
                   "--base_body=FILE and --tool_body=FILE (.rig, .rom), by their poses, or as just "
                   "three markers");
}

Eigen::Quaterniond OtherScalar(const Eigen::Quaterniond& q, RecordedBody::Scalar taken) {
  if (taken == RecordedBody::Scalar::kNamed) return q;
  return Shifted(q, taken == RecordedBody::Scalar::kFirst ? 3 : 1);
}

std::optional<Pose3d> PoseOf(const TrackedSide& side,
                             std::size_t row,
                             const AssembleOptions& options) {
  if (side.is_tracker) return Pose3d{};
  std::optional<Pose3d> pose = side.body->poses[row];
  if (pose && options.measured_other_scalar)
    pose->rotation = OtherScalar(pose->rotation, side.body->scalar);
  return pose && options.measured_inverse ? pose->Inverse() : pose;
}

// Of readings of one pose: of their positions, and of their rotations for small scatter.
Pose3d MeanPose(const std::vector<Pose3d>& poses) {
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
  Eigen::Vector4d rotation = Eigen::Vector4d::Zero();
  for (const Pose3d& pose : poses) {
    const double sign = pose.rotation.dot(poses.front().rotation) < 0.0 ? -1.0 : 1.0;
    translation += pose.translation;
    rotation += sign * pose.rotation.coeffs();
  }
  return {translation / static_cast<double>(poses.size()),
          Eigen::Quaterniond(Eigen::Vector4d(rotation)).normalized()};
}

void FillPoses(const Sides& sides,
               const Pairs& pairs,
               const AssembleOptions& options,
               Measurement& measurement) {
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    std::vector<Pose3d> seen;
    for (const TrackerRow& at : pairs[i]) {
      const std::optional<Pose3d> base = PoseOf(sides[at.file][0], at.row, options);
      const std::optional<Pose3d> tool = PoseOf(sides[at.file][1], at.row, options);
      if (base && tool) seen.push_back(base->Inverse() * *tool);
    }
    if (!seen.empty()) measurement.poses.push_back({static_cast<int>(i), MeanPose(seen)});
  }
}

void FillMarkers(const std::vector<Recording>& tracker,
                 const Sides& sides,
                 const Pairs& pairs,
                 Measurement& measurement) {
  std::size_t most_frames = 1;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    most_frames = std::max(most_frames, pairs[i].size());
    for (std::size_t frame = 0; frame < pairs[i].size(); ++frame) {
      const TrackerRow& at = pairs[i][frame];
      for (int body = 0; body < 2; ++body) {
        const std::vector<int>& markers = sides[at.file][static_cast<std::size_t>(body)].markers;
        for (std::size_t m = 0; m < markers.size(); ++m) {
          const std::optional<Eigen::Vector3d>& point =
              tracker[at.file].markers[static_cast<std::size_t>(markers[m])].points[at.row];
          if (point)
            measurement.readings.push_back({static_cast<int>(i),
                                            static_cast<int>(frame),
                                            static_cast<BodyId>(body),
                                            static_cast<int>(m),
                                            *point});
        }
      }
    }
  }
  if (most_frames == 1) return;
  for (std::size_t frame = 0; frame < most_frames; ++frame)
    measurement.frame_labels.push_back(std::to_string(frame + 1));
}

// What is on the base cannot be on the platform.
void RefuseShared(const Recording& recording, const TrackedSide& base, const TrackedSide& tool) {
  const auto is_of_base = [&base](int marker) {
    return std::find(base.markers.begin(), base.markers.end(), marker) != base.markers.end();
  };
  const bool is_shared = (base.body != nullptr && base.body == tool.body) ||
                         std::any_of(tool.markers.begin(), tool.markers.end(), is_of_base);
  if (is_shared)
    throw InputError(FileLocation(recording.path),
                     fmt::format("{} as --base and {} as --tool, which are the same or share a "
                                 "marker",
                                 Quoted(base.name),
                                 Quoted(tool.name)),
                     "one body on the base, another on the platform");
}

// Bodies of the same names in all files, with as many markers.
Sides ChooseSides(const std::vector<Recording>& tracker, const AssembleOptions& options) {
  Sides sides;
  for (const Recording& recording : tracker) {
    sides.push_back(
        {ChooseSide(recording, options.base, true), ChooseSide(recording, options.tool, false)});
    RefuseShared(recording, sides.back()[0], sides.back()[1]);
    for (const TrackedSide& side : sides.back()) CheckPlaces(recording, side);
    for (std::size_t body = 0; body < 2; ++body) {
      const TrackedSide &first = sides.front()[body], &here = sides.back()[body];
      if (here.markers.size() != first.markers.size() ||
          (here.body == nullptr) != (first.body == nullptr))
        throw InputError(FileLocation(recording.path),
                         fmt::format("{} markers of {}", here.markers.size(), Quoted(here.name)),
                         fmt::format("{} as in {}", first.markers.size(), tracker.front().path));
    }
  }
  return sides;
}

Measurement MakeMeasurement(const std::vector<Recording>& tracker,
                            const Sides& sides,
                            const Pairs& pairs,
                            const AssembleOptions& options,
                            Assembled& assembled) {
  Measurement measurement;
  measurement.where = FileLocation(tracker.front().path);
  measurement.kind = ChooseKind(tracker.front(), sides.front(), options);
  if (measurement.kind == Measurement::Kind::kPoses) {
    FillPoses(sides, pairs, options, measurement);
    assembled.bodies = {sides.front()[0].is_tracker ? "base is where the tracker is"
                                                    : fmt::format("base is {}, by its poses",
                                                                  Quoted(sides.front()[0].name)),
                        fmt::format("tool is {}, by its poses", Quoted(sides.front()[1].name))};
    return measurement;
  }
  for (std::size_t body = 0; body < 2; ++body) {
    std::vector<const TrackedSide*> side_of_file;
    for (const auto& of_file : sides) side_of_file.push_back(&of_file[body]);
    BodyShape shape = MakeBodyShape(tracker,
                                    side_of_file,
                                    body == 0 ? options.base_shape : options.tool_shape,
                                    options.measured_inverse,
                                    kMarkerPrefix[body]);
    assembled.bodies.push_back(fmt::format("{} is {}, {} markers {}",
                                           body == 0 ? "base" : "tool",
                                           Quoted(side_of_file.front()->name),
                                           shape.body.markers.size(),
                                           shape.origin));
    measurement.bodies[body] = std::move(shape.body);
    assembled.dataset.warnings.insert(
        assembled.dataset.warnings.end(), shape.warnings.begin(), shape.warnings.end());
  }
  FillMarkers(tracker, sides, pairs, measurement);
  return measurement;
}

void AddRepeats(const Recording& recording,
                bool labels_differ,
                std::vector<std::string>& warnings) {
  std::string warning = RepeatedRows(recording, labels_differ);
  if (!warning.empty()) warnings.push_back(std::move(warning));
}

std::string Described(const Recording& recording) {
  return fmt::format("{}, {} rows ({})", recording.path, recording.rows, recording.reading);
}

}  // namespace

Assembled Assemble(const Recording& robot,
                   const std::vector<Recording>& tracker,
                   const AssembleOptions& options) {
  Assembled assembled;
  Dataset& dataset = assembled.dataset;
  dataset.name = options.name;
  dataset.robot_poses = MakeRobotPoses(robot, options);
  dataset.tracker.is_static = options.static_tracker;
  dataset.warnings = robot.warnings;
  assembled.robot = Described(robot);
  if (tracker.empty()) return assembled;
  for (const Recording& recording : tracker)
    dataset.warnings.insert(
        dataset.warnings.end(), recording.warnings.begin(), recording.warnings.end());
  const bool labels_differ = options.pairing == Pairing::kRows && options.frames == 1;
  AddRepeats(robot, labels_differ, dataset.warnings);
  for (const Recording& recording : tracker) AddRepeats(recording, labels_differ, dataset.warnings);
  const Sides sides = ChooseSides(tracker, options);
  const Pairs pairs = PairRows(robot, tracker, options);
  AddTimes(robot, tracker, pairs, options, dataset.robot_poses);
  dataset.measurement = MakeMeasurement(tracker, sides, pairs, options, assembled);
  assembled.tracker = Described(tracker.front());
  if (tracker.size() > 1) assembled.tracker += fmt::format("; {} files more", tracker.size() - 1);
  return assembled;
}

}  // namespace hexcal
