// SPDX-License-Identifier: BSD-3-Clause
#include "apps/import_conventions.h"

#include <fmt/format.h>

#include "apps/message.h"
#include "estimator/conventions.h"
#include "measurement/tool_pose.h"

namespace hexcal {
namespace {

using Measured = std::vector<std::optional<Pose3d>>;  // world_from_tool, by row of the robot

Measured MeasuredPoses(const Dataset& dataset) {
  Measured measured(dataset.robot_poses.rows.size());
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

// Robot inverted, tracker inverted, base taken for tool: of the three the data cannot tell which it
// is, only that it is one.
std::string AlsoPossible(const Conventions& found, const Dataset& dataset) {
  const bool turns_robot = found.best.robot.is_inverse != found.stated.robot.is_inverse;
  if (turns_robot == (found.best.measured != 0)) return "";
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

// What to change, each with its flag where there is one.
std::string Words(const Conventions& found, const AssembleOptions& options, bool by_map) {
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
  if (found.best.measured != 0)
    words.push_back(options.measured_inverse
                        ? "the tracker's poses as they are (no --measured_inverse)"
                        : "the tracker's poses inverted (--measured_inverse)");
  return fmt::format("{}", fmt::join(words, ", "));
}

}  // namespace

std::optional<Conventions> CheckConventions(const Recording& robot,
                                            const std::vector<Recording>& tracker,
                                            const AssembleOptions& options,
                                            bool robot_by_map,
                                            const Dataset& dataset) {
  if (!dataset.measurement) return std::nullopt;
  std::vector<Measured> measured = {MeasuredPoses(dataset)};
  if (dataset.measurement->kind == Measurement::Kind::kPoses) {
    AssembleOptions other = options;
    other.kind = ImportKind::kPoses;
    other.measured_inverse = !options.measured_inverse;
    measured.push_back(MeasuredPoses(Assemble(robot, tracker, other).dataset));
  }
  const RecordedBody& body = robot.bodies.front();
  RobotReading stated;
  stated.order = body.rotation_order;
  stated.is_inverse = options.robot_inverse;
  const std::optional<Conventions> found = TryConventions(StatedPoses(body), measured, stated);
  if (!found) return std::nullopt;
  if (found->gain < kClearGain) return found;
  PrintWarning(
      fmt::format("{}: base and tool leave {:.3g} mm and {:.3g} mrad with the conventions "
                  "as stated, but {:.3g} mm and {:.3g} mrad with {}{}",
                  dataset.name,
                  1e3 * found->stated.rms_position,
                  1e3 * found->stated.rms_orientation,
                  1e3 * found->best.rms_position,
                  1e3 * found->best.rms_orientation,
                  Words(*found, options, robot_by_map),
                  AlsoPossible(*found, dataset)));
  return std::nullopt;
}

}  // namespace hexcal
