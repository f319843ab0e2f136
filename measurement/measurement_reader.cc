// SPDX-License-Identifier: BSD-3-Clause
#include "measurement/measurement_reader.h"

#include <fmt/format.h>

#include <algorithm>

#include "measurement/labels.h"
#include "measurement/marker_body_reader.h"
#include "measurement/marker_table.h"
#include "measurement/noise_reader.h"
#include "measurement/pose_columns.h"

namespace hexcal {
namespace {

constexpr int kFewestPoses = 3;

// Poses in which the tool was seen and, unless the tracker stood still throughout, the base too.
int CountMeasuredPoses(const Measurement& measurement, int num_poses, bool tracker_is_static) {
  if (measurement.kind == Measurement::Kind::kPoses)
    return static_cast<int>(measurement.poses.size());
  std::array<std::vector<char>, 2> seen = {std::vector<char>(num_poses),
                                           std::vector<char>(num_poses)};
  for (const MarkerReading& reading : measurement.readings)
    seen[static_cast<int>(reading.body)][reading.pose] = 1;
  const bool has_base = !measurement.bodies[0].markers.empty();
  const bool base_was_seen = !has_base || std::count(seen[0].begin(), seen[0].end(), 1) > 0;
  int count = 0;
  for (int pose = 0; pose < num_poses; ++pose)
    if (seen[1][pose] && (tracker_is_static || !has_base ? base_was_seen : seen[0][pose] == 1))
      ++count;
  return count;
}

void CheckEnoughPoses(const Measurement& measurement, int num_poses, bool tracker_is_static) {
  const int count = CountMeasuredPoses(measurement, num_poses, tracker_is_static);
  if (count >= kFewestPoses) return;
  const bool markers = measurement.kind == Measurement::Kind::kMarkers;
  throw InputError(measurement.where,
                   fmt::format("{} measured pose{}{}",
                               count,
                               count == 1 ? "" : "s",
                               markers ? " with both bodies seen" : ""),
                   fmt::format("at least {}", kFewestPoses));
}

Measurement::Kind ReadKind(const YamlNode& node) {
  const std::string kind = ReadText(node, "markers or poses");
  if (kind == "markers") return Measurement::Kind::kMarkers;
  if (kind == "poses") return Measurement::Kind::kPoses;
  throw InputError(node.where, fmt::format("the kind {}", Quoted(kind)), "markers or poses");
}

}  // namespace

void ReadPoseTable(TableReader& table,
                   const RobotPoses& robot_poses,
                   const ReadContext& context,
                   Measurement& measurement) {
  const PoseColumns columns(table, false, {});
  const int label_column = table.Column("pose");
  PoseIndex index(robot_poses);
  std::vector<int> line_of_pose(robot_poses.rows.size(), 0);
  bool has_warned = false;
  while (table.Next()) {
    const std::string_view label = table.Text(label_column);
    const int pose = index.Find(label);
    if (pose < 0)
      throw InputError(table.CellLocation(label_column),
                       fmt::format("a measurement of pose {}", Quoted(label)),
                       kKnownPose);
    if (line_of_pose[pose] > 0)
      throw InputError(
          table.CellLocation(label_column),
          fmt::format("the pose {} a second time", Quoted(label)),
          fmt::format("one measurement a pose (the first is in line {})", line_of_pose[pose]));
    line_of_pose[pose] = table.RowLocation().line;
    measurement.poses.push_back({pose, columns.ReadPose(table, context.units)});
    if (has_warned || context.units.angle != 1 || !columns.HasLargeAngle(table, context.units))
      continue;
    has_warned = true;
    context.warnings->push_back(
        fmt::format("{}: pose {} has an angle of more than a turn; is `angle: rad` right?",
                    table.RowLocation().ToString(),
                    Quoted(label)));
  }
}

Measurement ReadMeasurement(const YamlNode& node,
                            const RobotPoses& robot_poses,
                            bool tracker_is_static,
                            bool needs_readings,
                            const ReadContext& context,
                            bool needs_base) {
  const MapReader map(node, "measurement", {"kind", "file", "rows", "noise", "bodies"});
  Measurement measurement;
  measurement.kind = ReadKind(map.Required("kind"));
  const YamlNode* noise = map.Optional("noise");
  if (measurement.kind == Measurement::Kind::kMarkers) {
    measurement.bodies = ReadMarkerBodies(map.Required("bodies"), context.units, needs_base);
    if (noise != nullptr) {
      const MapReader noise_map(*noise, "the noise of markers", {"sigma"});
      measurement.marker_sigma =
          context.units.length * ReadSigmas(noise_map.Required("sigma"), "a marker coordinate");
    }
  } else {
    if (const YamlNode* bodies = map.Optional("bodies"))
      throw InputError(bodies->where, "bodies with kind poses", "them only with kind markers");
    if (noise != nullptr) measurement.pose_noise = ReadPoseNoise(*noise, context.units);
  }

  measurement.where = map.where();
  if (!needs_readings && !map.Has("file") && !map.Has("rows")) return measurement;

  TableReader table = OpenTable(map, "measurement", context);
  measurement.where = table.where();
  if (measurement.kind == Measurement::Kind::kMarkers)
    ReadMarkerTable(table, robot_poses, context.units, measurement);
  else
    ReadPoseTable(table, robot_poses, context, measurement);
  CheckEnoughPoses(measurement, static_cast<int>(robot_poses.rows.size()), tracker_is_static);
  return measurement;
}

}  // namespace hexcal
