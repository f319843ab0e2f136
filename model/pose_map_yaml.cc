// SPDX-License-Identifier: BSD-3-Clause
#include "model/pose_map_yaml.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <vector>

#include "config/yaml_number.h"
#include "measurement/hexapod_geometry.h"

namespace hexcal {
namespace {

Vector6d ReadCoordinates(const YamlNode& node, std::string_view expected) {
  return Eigen::Map<const Vector6d>(ReadNumbers(node, 6, expected).data());
}

int ReadDegree(const YamlNode& node) {
  const long degree = ReadInteger(node, "1 or 2");
  if (degree == 1 || degree == 2) return static_cast<int>(degree);
  throw InputError(node.where, fmt::format("the degree {}", degree), "1 or 2");
}

void ReadBox(const YamlNode& node, PoseMap* map) {
  const MapReader box(node, "the box of pose_map", {"centre", "half_width"});
  map->centre = ReadCoordinates(box.Required("centre"), "six coordinates, m and rad");
  const YamlNode& width = box.Required("half_width");
  map->half_width = ReadCoordinates(width, "six half-widths, m and rad");
  if (map->half_width.minCoeff() < 0.0)
    throw InputError(width.where, "a half-width below zero", "six half-widths, m and rad");
}

std::string List(const Eigen::VectorXd& numbers) {
  return YamlNumbers(numbers.data(), static_cast<int>(numbers.size()));
}

}  // namespace

PoseMap ReadPoseMap(const YamlNode& node) {
  const MapReader reader(node, "pose_map", {"degree", "reference", "box", "coefficients"});
  PoseMap map;
  map.degree = ReadDegree(reader.Required("degree"));
  map.reference = ReadPose(reader.Required("reference"), Units(), "the reference of pose_map");
  ReadBox(reader.Required("box"), &map);
  const YamlNode& rows = reader.Required("coefficients");
  const std::vector<YamlNode>& items = ReadSequence(rows, "six lists of coefficients");
  if (items.size() != 6) throw InputError(rows.where, Describe(rows), "six lists of coefficients");
  const int terms = PoseMapTermCount(map.degree);
  map.coefficients.resize(6, terms);
  for (int i = 0; i < 6; ++i)
    map.coefficients.row(i) = Eigen::Map<const Eigen::RowVectorXd>(
        ReadNumbers(items[i], terms, fmt::format("{} coefficients", terms)).data(), terms);
  return map;
}

std::string WritePoseMap(const PoseMap& map, const std::string& indent) {
  std::string text = fmt::format("{}degree: {}\n", indent, map.degree);
  text += fmt::format("{}reference: {}\n", indent, WritePose(map.reference));
  text += fmt::format(
      "{}box: {{centre: {}, half_width: {}}}\n", indent, List(map.centre), List(map.half_width));
  text += fmt::format("{}coefficients:\n", indent);
  for (int i = 0; i < 6; ++i)
    text += fmt::format("{}  - {}\n", indent, List(map.coefficients.row(i)));
  return text;
}

}  // namespace hexcal
