// SPDX-License-Identifier: BSD-3-Clause
#include "measurement/importers/column_map.h"

#include <fmt/format.h>

#include <algorithm>

#include "geometry/rotation_order.h"
#include "measurement/labels.h"
#include "measurement/units_reader.h"

namespace hexcal {
namespace {

constexpr std::string_view kFormat = "hexcal/columns/1";
constexpr long kMostSkipped = 1000;

template <typename Value>
using Choices = std::vector<std::pair<std::string_view, Value>>;

template <typename Value>
Value ReadChoice(const YamlNode& node, const Choices<Value>& choices) {
  const std::string text = ReadText(node, "one word");
  std::string expected;
  for (const auto& [word, value] : choices) {
    if (word == text) return value;
    expected += fmt::format("{}{}", expected.empty() ? "" : ", ", word);
  }
  throw InputError(node.where, Quoted(text), "one of " + expected);
}

ColumnName ReadColumn(const YamlNode& node) {
  return {ReadText(node, "the name of a column, or its number"), node.where};
}

std::vector<ColumnName> ReadColumns(const YamlNode& node, std::size_t size) {
  const std::string expected = fmt::format("a list of {} columns", size);
  std::vector<ColumnName> columns;
  for (const YamlNode& item : ReadSequence(node, expected)) columns.push_back(ReadColumn(item));
  if (columns.size() != size) throw InputError(node.where, Describe(node), expected);
  return columns;
}

const std::vector<std::pair<YamlNode, YamlNode>>& EntriesOf(const YamlNode& node,
                                                            std::string_view expected) {
  if (node.kind != YamlNode::Kind::kMap) throw InputError(node.where, Describe(node), expected);
  return node.entries;
}

void ReadOrder(const YamlNode& node, MappedBody& body) {
  body.order = ReadText(node, "an order of rotations");
  if (body.kind != MappedBody::Rotation::kAngles)
    throw InputError(node.where, "an order", "none but beside 'angles'");
  if (!IsRotationOrder(body.order))
    throw InputError(node.where,
                     Quoted(body.order),
                     "the factors of the rotation from left to right: xyz, zyx, zyz, ...");
}

MappedBody ReadBody(const YamlNode& name, const YamlNode& node) {
  MappedBody body;
  body.name = name.scalar;
  const MapReader map(node,
                      fmt::format("the body {}", Quoted(body.name)),
                      {"position", "angles", "quaternion", "matrix", "order", "markers"});
  body.position = ReadColumns(map.Required("position"), 3);
  using Rotation = MappedBody::Rotation;
  const std::vector<std::tuple<std::string_view, Rotation, std::size_t>> kinds = {
      {"angles", Rotation::kAngles, 3},
      {"quaternion", Rotation::kQuaternion, 4},
      {"matrix", Rotation::kMatrix, 9}};
  for (const auto& [key, kind, size] : kinds) {
    const YamlNode* columns = map.Optional(key);
    if (columns == nullptr) continue;
    if (!body.rotation.empty())
      throw InputError(columns->where, "a second rotation", "one of angles, quaternion, matrix");
    body.kind = kind;
    body.rotation = ReadColumns(*columns, size);
  }
  if (body.rotation.empty())
    throw InputError(map.where(), "no rotation", "one of angles, quaternion (w x y z), matrix");
  if (const YamlNode* order = map.Optional("order")) ReadOrder(*order, body);
  if (const YamlNode* markers = map.Optional("markers"))
    for (const YamlNode& marker : ReadSequence(*markers, "a list of markers"))
      body.markers.push_back(ReadText(marker, "the name of a marker"));
  return body;
}

void CheckMarkers(const YamlNode& node, const ColumnMap& map) {
  for (const MappedBody& body : map.bodies)
    for (const std::string& name : body.markers)
      if (std::none_of(map.markers.begin(), map.markers.end(), [&name](const MappedMarker& marker) {
            return marker.name == name;
          }))
        throw InputError(node.where,
                         fmt::format("the marker {} of {}", Quoted(name), Quoted(body.name)),
                         "one that 'markers' of the map has");
}

void ReadLayout(const MapReader& map, ColumnMap& columns) {
  if (const YamlNode* node = map.Optional("delimiter"))
    columns.delimiter = ReadChoice<char>(
        *node, {{"comma", ','}, {"semicolon", ';'}, {"tab", '\t'}, {"blanks", ' '}, {"bar", '|'}});
  if (const YamlNode* node = map.Optional("decimal_comma")) columns.decimal_comma = ReadBool(*node);
  if (columns.decimal_comma && columns.delimiter == ',')
    throw InputError(map.where(), "a decimal comma between commas", "another delimiter");
  if (const YamlNode* node = map.Optional("skip")) {
    columns.skip = ReadInteger(*node, "a number of lines");
    if (columns.skip < 0 || columns.skip > kMostSkipped)
      throw InputError(node->where, Describe(*node), fmt::format("0 to {} lines", kMostSkipped));
  }
  if (const YamlNode* node = map.Optional("header")) columns.has_header = ReadBool(*node);
  if (const YamlNode* node = map.Optional("comment")) columns.comment = ReadText(*node);
  if (const YamlNode* node = map.Optional("missing")) columns.missing = ReadNumber(*node);
}

}  // namespace

ColumnMap ReadColumnMap(const std::string& path) {
  const YamlNode root = ParseYamlFile(path, {8, 100'000, 1 << 20});
  const MapReader map(root,
                      "the column map",
                      {"format",
                       "delimiter",
                       "decimal_comma",
                       "skip",
                       "header",
                       "comment",
                       "units",
                       "missing",
                       "time",
                       "label",
                       "bodies",
                       "markers"});
  const YamlNode& format = map.Required("format");
  if (ReadText(format, kFormat) != kFormat)
    throw InputError(format.where, Quoted(format.scalar), kFormat);
  ColumnMap columns;
  columns.units = ReadUnits(map.Required("units"));
  ReadLayout(map, columns);
  if (const YamlNode* node = map.Optional("label")) columns.label = ReadColumn(*node);
  if (const YamlNode* node = map.Optional("time")) {
    const MapReader time(*node, "time", {"column", "unit"});
    columns.time = ReadColumn(time.Required("column"));
    columns.time_unit = ReadChoice<double>(time.Required("unit"),
                                           {{"s", 1.0}, {"ms", 1e-3}, {"us", 1e-6}, {"ns", 1e-9}});
  }
  if (const YamlNode* node = map.Optional("bodies"))
    for (const auto& [name, body] : EntriesOf(*node, "bodies by their names"))
      columns.bodies.push_back(ReadBody(name, body));
  if (const YamlNode* node = map.Optional("markers"))
    for (const auto& [name, position] : EntriesOf(*node, "markers by their names"))
      columns.markers.push_back({name.scalar, ReadColumns(position, 3)});
  if (columns.bodies.empty() && columns.markers.empty())
    throw InputError(root.where, "neither bodies nor markers", "some of them, as mappings");
  CheckMarkers(root, columns);
  return columns;
}

}  // namespace hexcal
