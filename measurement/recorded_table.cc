// SPDX-License-Identifier: BSD-3-Clause
#include "measurement/recorded_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <map>

#include "geometry/rotation_angles.h"
#include "measurement/table_input.h"

namespace hexcal {
namespace {

const YamlNode& Entry(const YamlNode& map, std::string_view key) {
  for (const auto& [name, value] : map.entries)
    if (name.scalar == key) return value;
  throw InputError(map.where, "no such key", fmt::format("'{}'", key));
}

// All numbers of a row, in the table's units, by column.
std::map<std::string, double> CellsOf(const RecordedColumns& columns,
                                      const RobotPoses& poses,
                                      std::size_t row,
                                      const Pose3d& pose) {
  const double length = columns.units.length, angle = columns.units.angle;
  std::map<std::string, double> cells;
  const auto set = [&](std::initializer_list<const char*> names, const auto& values, double unit) {
    int k = 0;
    for (const char* name : names) cells[name] = values(k++) / unit;
  };
  const Eigen::Matrix3d rotation = pose.rotation.toRotationMatrix();
  const Eigen::Vector3d angles = AnglesFromRotation(rotation);
  const Eigen::Quaterniond& q = pose.rotation;
  const Eigen::Vector4d quaternion(q.w(), q.x(), q.y(), q.z());
  set({"x", "y", "z"}, pose.translation, length);
  set({"rx", "ry", "rz"}, angles, angle);
  set({"qw", "qx", "qy", "qz"}, quaternion, 1.0);
  set(
      {"r11", "r12", "r13", "r21", "r22", "r23", "r31", "r32", "r33"},
      [&](int k) { return rotation(k / 3, k % 3); },
      1.0);
  for (int leg = 0; leg < kNumLegs; ++leg)
    cells[fmt::format("l{}", leg + 1)] = poses.rows[row].leg_lengths[leg] / length;
  for (const Covariate& covariate : poses.covariates)
    cells[covariate.name] = covariate.values[row] / covariate.unit.factor;
  return cells;
}

}  // namespace

RecordedColumns ReadRecordedColumns(const std::string& dataset_path) {
  const YamlNode root = ParseYamlFile(dataset_path);
  const YamlNode& units = Entry(root, "units");
  RecordedColumns columns;
  columns.units = {FindLengthUnit(Entry(units, "length").scalar).value().factor,
                   FindAngleUnit(Entry(units, "angle").scalar).value().factor};
  const MapReader table(Entry(root, "robot_poses"), "robot_poses", {"file", "rows", "noise"});
  columns.names = OpenTable(table, "robot_poses", {dataset_path, columns.units, nullptr}).header();
  return columns;
}

std::string RecordedTable(const RecordedColumns& columns,
                          const RobotPoses& poses,
                          const std::vector<Pose3d>& base_from_platform) {
  std::string text = fmt::format("{}\n", fmt::join(columns.names, ","));
  for (std::size_t row = 0; row < poses.rows.size(); ++row) {
    const auto cells = CellsOf(columns, poses, row, base_from_platform.at(row));
    std::vector<std::string> line;
    for (const std::string& name : columns.names)
      line.push_back(name == "pose" ? poses.rows[row].label : fmt::format("{}", cells.at(name)));
    text += fmt::format("{}\n", fmt::join(line, ","));
  }
  return text;
}

}  // namespace hexcal
