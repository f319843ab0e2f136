// SPDX-License-Identifier: BSD-3-Clause
#include "measurement/pivoting.h"

#include <string_view>
#include <unordered_set>

#include "measurement/dataset_header.h"
#include "measurement/labels.h"
#include "measurement/measurement_reader.h"
#include "measurement/units_reader.h"

namespace hexcal {
namespace {

constexpr std::string_view kFormat = "hexcal/pivoting/1";

// The poses that a table names, each where it stands first. A table without labels is refused by
// whoever reads the rest of it.
RobotPoses ListPoses(TableReader table) {
  RobotPoses poses;
  const int column = table.Column("pose");
  std::unordered_set<std::string> seen;
  while (column >= 0 && table.Next()) {
    const std::string label(table.Text(column));
    if (!seen.insert(label).second) continue;
    CheckLabel(label, table.CellLocation(column), "pose label");
    RobotPose pose{};
    pose.label = label;
    pose.line = table.RowLocation().line;
    poses.rows.push_back(pose);
  }
  return poses;
}

}  // namespace

Pivoting ReadPivoting(const std::string& path) {
  const YamlNode root = ParseYamlFile(path);
  CheckFormat(root, kFormat);
  const MapReader map(root,
                      "the description of the pivoting",
                      {"format", "name", "description", "units", "tracker", "measurement"});
  Pivoting pivoting;
  Dataset& dataset = pivoting.dataset;
  dataset.path = path;
  dataset.name = ReadName(map.Required("name"));
  if (const YamlNode* text = map.Optional("description")) dataset.description = ReadText(*text);
  const ReadContext context{path, ReadUnits(map.Required("units")), &dataset.warnings};
  if (const YamlNode* node = map.Optional("tracker"))
    dataset.tracker.is_static =
        ReadBool(MapReader(*node, "tracker", {"static"}).Required("static"));
  const YamlNode& node = map.Required("measurement");
  const MapReader measurement(node, "measurement", {"kind", "file", "rows", "noise", "bodies"});
  dataset.robot_poses = ListPoses(OpenTable(measurement, "measurement", context));
  dataset.measurement =
      ReadMeasurement(node, dataset.robot_poses, dataset.tracker.is_static, true, context, false);
  pivoting.poses = ComputeToolPoses(dataset);
  return pivoting;
}

Pivoting ReadPivotingTable(const std::string& path, const Units& units, const std::string& name) {
  Pivoting pivoting;
  Dataset& dataset = pivoting.dataset;
  dataset.path = path;
  dataset.name = name;
  dataset.robot_poses = ListPoses(TableReader::FromFile(path));
  dataset.measurement = Measurement{};
  TableReader table = TableReader::FromFile(path);
  dataset.measurement->where = table.where();
  ReadPoseTable(table, dataset.robot_poses, {path, units, &dataset.warnings}, *dataset.measurement);
  pivoting.poses = ComputeToolPoses(dataset);
  return pivoting;
}

}  // namespace hexcal
