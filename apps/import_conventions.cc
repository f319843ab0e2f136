// SPDX-License-Identifier: BSD-3-Clause
#include "apps/import_conventions.h"

#include <fmt/format.h>

#include "apps/message.h"
#include "estimator/conventions.h"
#include "measurement/importers/tracked_side.h"
#include "measurement/tool_pose.h"

namespace hexcal {
namespace {

// A way to read the tracker's files, beside the stated one.
struct TrackerReading {
  bool is_turned = false;     // poses the other way round than stated
  bool other_scalar = false;  // quaternions with the scalar at the other end
};

// world_from_tool, by row of the robot.
std::vector<std::optional<Pose3d>> MeasuredPoses(const Dataset& dataset) {
  std::vector<std::optional<Pose3d>> measured(dataset.robot_poses.rows.size());
  for (const ToolPose& pose : ComputeToolPoses(dataset).poses)
    measured[static_cast<std::size_t>(pose.pose)] = pose.world_from_tool;
  return measured;
}

std::vector<StatedPose> StatedPoses(const RecordedBody& robot) {
  std::vector<StatedPose> poses;
  for (std::size_t i = 0; i < robot.poses.size(); ++i)
    poses.push_back(
        {*robot.poses[i], robot.vectors.empty() ? std::optional<Vector6d>() : robot.vectors[i]});
  return poses;
}

// Where the scalar of the tool's quaternions is taken to stand, or of the base's; kNamed where the
// files leave no doubt.
RecordedBody::Scalar ScalarOf(const Recording& tracker, const AssembleOptions& options) {
  for (const bool is_base : {false, true}) {
    const TrackedSide side = ChooseSide(tracker, is_base ? options.base : options.tool, is_base);
    if (side.body != nullptr && side.body->scalar != RecordedBody::Scalar::kNamed)
      return side.body->scalar;
  }
  return RecordedBody::Scalar::kNamed;
}

std::vector<TrackerReading> TrackerReadings(const Dataset& dataset, RecordedBody::Scalar scalar) {
  std::vector<TrackerReading> readings = {{}};
  if (dataset.measurement->kind != Measurement::Kind::kPoses) return readings;
  readings.push_back({true, false});
  if (scalar != RecordedBody::Scalar::kNamed)
    readings.insert(readings.end(), {{false, true}, {true, true}});
  return readings;
}

MeasuredReading MeasuredBy(const TrackerReading& reading,
                           const Recording& robot,
                           const std::vector<Recording>& tracker,
                           AssembleOptions options) {
  options.kind = ImportKind::kPoses;
  if (reading.is_turned) options.measured_inverse = !options.measured_inverse;
  options.measured_other_scalar = reading.other_scalar;
  return {MeasuredPoses(Assemble(robot, tracker, options).dataset),
          reading.is_turned + reading.other_scalar};
}

// Robot inverted, tracker inverted, base taken for tool: of the three the data cannot tell which it
// is, only that it is one.
std::string AlsoPossible(const Conventions& found,
                         const TrackerReading& tracker,
                         const Dataset& dataset) {
  const bool turns_robot = found.best.robot.is_inverse != found.stated.robot.is_inverse;
  if (turns_robot == tracker.is_turned) return "";
  const bool by_poses = dataset.measurement->kind == Measurement::Kind::kPoses;
  std::vector<std::string_view> others;
  if (!turns_robot) others.push_back("with the robot's inverted (--robot_inverse)");
  if (turns_robot && by_poses) others.push_back("with the tracker's inverted (--measured_inverse)");
  others.push_back("with base and tool interchanged (--base, --tool)");
  return fmt::format(
      "; as well {}: which it is no data can tell, and base and tool of the wrong "
      "one are wrong",
      fmt::join(others, " and "));
}

// What to change of the robot's, each with its flag where there is one.
std::vector<std::string> RobotWords(const Conventions& found, bool by_map) {
  const RobotReading &stated = found.stated.robot, &best = found.best.robot;
  std::vector<std::string> words;
  if (best.order != stated.order)
    words.push_back(fmt::format("the robot's angles in the order {} ({}{})",
                                best.order,
                                by_map ? "in the column map, order: " : "--robot_rotation=",
                                best.order));
  if (best.is_transposed) words.push_back("the robot's rotations the other way round (transposed)");
  if (best.quaternion_shift != 0)
    words.push_back(fmt::format("the scalar of the robot's quaternions {}",
                                best.quaternion_shift == 1 ? "first" : "last"));
  if (best.angle_factor != 1.0)
    words.push_back(best.angle_factor < 1.0
                        ? "the robot's angles in degrees, where rad was taken"
                        : "the robot's angles in rad, where degrees were taken");
  if (best.length_factor != 1.0)
    words.push_back(best.length_factor < 1.0
                        ? "the robot's lengths a thousandth of what was taken"
                        : "the robot's lengths a thousand times what was taken");
  if (best.is_inverse != stated.is_inverse)
    words.push_back(best.is_inverse ? "the robot's poses inverted (--robot_inverse)"
                                    : "the robot's poses as they are (no --robot_inverse)");
  return words;
}

// And of the tracker's. scalar: where it was taken to stand.
std::vector<std::string> TrackerWords(const TrackerReading& best,
                                      const AssembleOptions& options,
                                      RecordedBody::Scalar scalar,
                                      bool by_map) {
  std::vector<std::string> words;
  if (best.other_scalar)
    words.push_back(fmt::format("the scalar of the tracker's quaternions {}{}",
                                scalar == RecordedBody::Scalar::kFirst ? "last" : "first",
                                by_map ? " (in the column map, quaternion: w x y z)" : ""));
  if (best.is_turned)
    words.push_back(options.measured_inverse
                        ? "the tracker's poses as they are (no --measured_inverse)"
                        : "the tracker's poses inverted (--measured_inverse)");
  return words;
}

}  // namespace

std::optional<Conventions> CheckConventions(const Recording& robot,
                                            const std::vector<Recording>& tracker,
                                            const AssembleOptions& options,
                                            const ByMap& by_map,
                                            const Dataset& dataset) {
  if (!dataset.measurement) return std::nullopt;
  const RecordedBody::Scalar scalar = ScalarOf(tracker.front(), options);
  const std::vector<TrackerReading> readings = TrackerReadings(dataset, scalar);
  std::vector<MeasuredReading> measured = {{MeasuredPoses(dataset), 0}};
  for (std::size_t i = 1; i < readings.size(); ++i)
    measured.push_back(MeasuredBy(readings[i], robot, tracker, options));
  const RecordedBody& body = robot.bodies.front();
  RobotReading stated;
  stated.order = body.rotation_order;
  stated.is_inverse = options.robot_inverse;
  const std::optional<Conventions> found = TryConventions(StatedPoses(body), measured, stated);
  if (!found) return std::nullopt;
  if (found->gain < kClearGain) return found;
  const TrackerReading& best = readings[found->best.measured];
  std::vector<std::string> words = RobotWords(*found, by_map.robot);
  for (std::string& word : TrackerWords(best, options, scalar, by_map.tracker))
    words.push_back(std::move(word));
  PrintWarning(
      fmt::format("{}: base and tool leave {:.3g} mm and {:.3g} mrad with the conventions "
                  "as stated, but {:.3g} mm and {:.3g} mrad with {}{}",
                  dataset.name,
                  1e3 * found->stated.rms_position,
                  1e3 * found->stated.rms_orientation,
                  1e3 * found->best.rms_position,
                  1e3 * found->best.rms_orientation,
                  fmt::join(words, ", "),
                  AlsoPossible(*found, best, dataset)));
  return std::nullopt;
}

}  // namespace hexcal
