// SPDX-License-Identifier: BSD-3-Clause
#include "measurement/marker_body_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "measurement/checked_values.h"
#include "measurement/labels.h"

namespace hexcal {
namespace {

// Two markers in one place, or {-1, -1}: neighbours once the coordinates are sorted.
std::array<int, 2> FindCoincident(const Eigen::Matrix3Xd& points) {
  std::vector<int> order(points.cols());
  std::iota(order.begin(), order.end(), 0);
  const auto before = [&](int a, int b) {
    const auto pa = points.col(a), pb = points.col(b);
    return std::lexicographical_compare(pa.begin(), pa.end(), pb.begin(), pb.end());
  };
  std::sort(order.begin(), order.end(), before);
  for (std::size_t i = 1; i < order.size(); ++i)
    if (points.col(order[i - 1]) == points.col(order[i]))
      return {std::min(order[i - 1], order[i]), std::max(order[i - 1], order[i])};
  return {-1, -1};
}

void ReadRigidMarkers(const YamlNode& node,
                      const std::string& what,
                      const Units& units,
                      MarkerBody& body) {
  if (node.kind != YamlNode::Kind::kMap)
    throw InputError(node.where,
                     Describe(node),
                     fmt::format("the markers of {} with their coordinates, {{name: [x, y, z], "
                                 "...}}, as its frame is rigid",
                                 what));
  if (node.entries.size() < 3)
    throw InputError(
        node.where, fmt::format("{} markers of {}", node.entries.size(), what), "at least 3");
  body.p_in_body.resize(3, node.entries.size());
  for (std::size_t i = 0; i < node.entries.size(); ++i) {
    const auto& [name, coordinates] = node.entries[i];
    CheckLabel(name.scalar, name.where, "marker name");
    const std::vector<double> xyz = ReadNumbers(coordinates, 3, "a point [x, y, z]");
    body.p_in_body.col(i) = units.length * Eigen::Vector3d(xyz[0], xyz[1], xyz[2]);
    body.markers.push_back(name.scalar);
  }
  const auto [first, second] = FindCoincident(body.p_in_body);
  if (first >= 0)
    throw InputError(node.entries[second].first.where,
                     fmt::format("markers {} and {} of {} in one place",
                                 body.markers[first],
                                 body.markers[second],
                                 what),
                     "markers apart from each other");
  if (AreCollinear(body.p_in_body))
    throw InputError(node.where,
                     fmt::format("the markers of {} on one line", what),
                     "at least three markers that are not, else no frame can be fitted to them");
}

void ReadCentroidMarkers(const YamlNode& node, const std::string& what, MarkerBody& body) {
  const std::string expected =
      fmt::format("the names of the three markers of {}, as its frame is centroid", what);
  for (const YamlNode& item : ReadSequence(node, expected)) {
    const std::string name = ReadText(item, "the name of a marker");
    CheckLabel(name, item.where, "marker name");
    if (std::find(body.markers.begin(), body.markers.end(), name) != body.markers.end())
      throw InputError(
          item.where, fmt::format("the marker {} a second time", Quoted(name)), "each marker once");
    body.markers.push_back(name);
    if (body.markers.size() > 3) break;
  }
  if (body.markers.size() != 3) throw InputError(node.where, Describe(node), expected);
}

void ReadXAxis(const YamlNode& node, const std::string& what, MarkerBody& body) {
  const std::string expected = fmt::format(
      "two different markers of {}: the x axis points from "
      "the first to the second",
      what);
  const std::vector<YamlNode>& ends = ReadSequence(node, expected);
  if (ends.size() != 2) throw InputError(node.where, Describe(node), expected);
  for (int i = 0; i < 2; ++i) {
    const std::string name = ReadText(ends[i], "the name of a marker");
    const auto found = std::find(body.markers.begin(), body.markers.end(), name);
    if (found == body.markers.end())
      throw InputError(ends[i].where, fmt::format("the marker {}", Quoted(name)), expected);
    body.x_axis[i] = static_cast<int>(found - body.markers.begin());
  }
  if (body.x_axis[0] == body.x_axis[1])
    throw InputError(
        ends[1].where, fmt::format("{} twice", body.markers[body.x_axis[0]]), expected);
}

MarkerBody ReadBody(const YamlNode& node, std::string_view name, const Units& units) {
  const std::string what = fmt::format("the {} body", name);
  const MapReader map(node, what, {"frame", "markers", "x_axis"});
  const YamlNode& frame = map.Required("frame");
  const std::string kind = ReadText(frame, "rigid or centroid");
  MarkerBody body;
  body.is_centroid = kind == "centroid";
  if (!body.is_centroid && kind != "rigid")
    throw InputError(frame.where, fmt::format("the frame {}", Quoted(kind)), "rigid or centroid");
  if (body.is_centroid) {
    ReadCentroidMarkers(map.Required("markers"), what, body);
    ReadXAxis(map.Required("x_axis"), what, body);
  } else {
    ReadRigidMarkers(map.Required("markers"), what, units, body);
    if (const YamlNode* x_axis = map.Optional("x_axis"))
      throw InputError(x_axis->where,
                       fmt::format("an x_axis for {}, whose frame is rigid", what),
                       "none: the markers' coordinates already define the axes");
  }
  return body;
}

}  // namespace

std::array<MarkerBody, 2> ReadMarkerBodies(const YamlNode& node,
                                           const Units& units,
                                           bool needs_base) {
  const MapReader map(node, "bodies", {kBodyNames[0], kBodyNames[1]});
  std::array<MarkerBody, 2> bodies;
  if (needs_base || map.Has(kBodyNames[0]))
    bodies[0] = ReadBody(map.Required(kBodyNames[0]), kBodyNames[0], units);
  bodies[1] = ReadBody(map.Required(kBodyNames[1]), kBodyNames[1], units);
  return bodies;
}

}  // namespace hexcal
