// SPDX-License-Identifier: BSD-3-Clause
#include "report/pivot_point.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geometry/covariance.h"
#include "measurement/table_input.h"

namespace hexcal {
namespace {

constexpr std::string_view kFormat = "hexcal/pivot/1";
constexpr const char* kExpected = "a pivot.json of hexcal";
constexpr double kLargest = 1e6;     // m: beyond it no tool is meant
constexpr double kSamePlace = 1e-9;  // m

// JSON is read as the YAML that it is, for the line numbers.
const YamlNode* Find(const YamlNode& map, std::string_view key) {
  if (map.kind != YamlNode::Kind::kMap) throw InputError(map.where, Describe(map), kExpected);
  for (const auto& [name, value] : map.entries)
    if (name.scalar == key) return &value;
  return nullptr;
}

const YamlNode& Key(const YamlNode& map, std::string_view key) {
  if (const YamlNode* value = Find(map, key)) return *value;
  throw InputError(map.where, fmt::format("no key '{}'", key), kExpected);
}

Eigen::Vector3d ReadVector(const YamlNode& node) {
  const auto xyz = ReadNumbers(node, 3, "three numbers");
  const Eigen::Vector3d v(xyz[0], xyz[1], xyz[2]);
  if (!(v.norm() < kLargest))
    throw InputError(node.where, "numbers beyond any tool", "metres of a tool");
  return v;
}

Eigen::Matrix3d ReadCovariance(const YamlNode& node) {
  const auto& rows = ReadSequence(node, "3 rows of 3 numbers");
  if (rows.size() != 3) throw InputError(node.where, Describe(node), "3 rows of 3 numbers");
  Eigen::Matrix3d covariance;
  for (int i = 0; i < 3; ++i) covariance.row(i) = ReadVector(rows[i]).transpose();
  if (!IsCovariance(covariance))
    throw InputError(node.where, "a matrix that is no covariance", "a symmetric, positive one");
  return 0.5 * (covariance + covariance.transpose());
}

std::optional<MarkerBody> ReadTool(const YamlNode& node) {
  if (node.kind == YamlNode::Kind::kNull) return std::nullopt;
  MarkerBody body;
  for (const YamlNode& name : ReadSequence(Key(node, "markers"), "names of markers"))
    body.markers.push_back(ReadText(name));
  const YamlNode& points = Key(node, "xyz");
  body.is_centroid = points.kind == YamlNode::Kind::kNull;
  if (body.is_centroid) {
    const auto& axis = ReadSequence(Key(node, "x_axis"), "two indices");
    if (axis.size() != 2) throw InputError(node.where, Describe(node), "two indices");
    for (int i = 0; i < 2; ++i) body.x_axis[i] = static_cast<int>(ReadInteger(axis[i]));
    return body;
  }
  const auto& list = ReadSequence(points, "a point for each marker");
  body.p_in_body.resize(3, static_cast<Eigen::Index>(list.size()));
  for (std::size_t i = 0; i < list.size(); ++i)
    body.p_in_body.col(static_cast<Eigen::Index>(i)) = ReadVector(list[i]);
  return body;
}

// Where the markers are makes the frame; of a rigid body their names and order do not matter.
bool IsSame(const MarkerBody& a, const MarkerBody& b) {
  if (a.is_centroid != b.is_centroid) return false;
  if (a.is_centroid) return a.markers == b.markers && a.x_axis == b.x_axis;
  if (a.p_in_body.cols() != b.p_in_body.cols()) return false;
  for (Eigen::Index i = 0; i < a.p_in_body.cols(); ++i) {
    const Eigen::Vector3d p = a.p_in_body.col(i);
    if (!((b.p_in_body.colwise() - p).colwise().norm().minCoeff() < kSamePlace)) return false;
  }
  return true;
}

void AddDoubtOfFit(const YamlNode& root, std::vector<std::string>* doubts) {
  const YamlNode* test = Find(root, "chi_square");
  if (test == nullptr || !ReadBool(Key(*test, "is_a_test"))) return;
  const double value = ReadNumber(Key(*test, "value")), high = ReadNumber(Key(*test, "high"));
  const double dof = ReadNumber(Key(*test, "degrees_of_freedom"));
  if (value <= high) return;
  doubts->push_back(
      fmt::format("more is left over than its stated noise explains (chi-square {:.5g} with {} "
                  "degrees of freedom, not above {:.4g} with 97.5 %)",
                  value,
                  dof,
                  high));
}

bool IsSamePose(const YamlNode& a, const YamlNode& b) {
  return Key(a, "pose").scalar == Key(b, "pose").scalar &&
         Key(a, "line").scalar == Key(b, "line").scalar;
}

void AddDoubtOfOutliers(const YamlNode& root, std::vector<std::string>* doubts) {
  const YamlNode *outliers = Find(root, "outliers"), *poses = Find(root, "poses");
  if (outliers == nullptr || poses == nullptr) return;
  std::string used;
  for (const YamlNode& outlier : ReadSequence(*outliers, "the outliers"))
    for (const YamlNode& pose : ReadSequence(*poses, "the readings"))
      if (IsSamePose(outlier, pose) && ReadBool(Key(pose, "used")))
        used += fmt::format("{}{} ({:.3g} sigma off)",
                            used.empty() ? "" : ", ",
                            Key(pose, "pose").scalar,
                            ReadNumber(Key(outlier, "sigmas")));
  if (!used.empty())
    doubts->push_back("a reading that the others contradict was used all the same: pose " + used);
}

}  // namespace

PivotPoint ReadPivotPoint(const YamlNode& node, const std::string& context_path) {
  PivotPoint point;
  point.path = PathBeside(node, context_path, "a pivot.json", "the requirement file's folder");
  point.where = node.where;
  const YamlNode root = ParseYamlFile(point.path);
  const YamlNode& format = Key(root, "format");
  if (ReadText(format, kFormat) != kFormat)
    throw InputError(format.where, Describe(format), fmt::format("'{}'", kFormat));
  const YamlNode& trustworthy = Key(root, "trustworthy");
  if (!ReadBool(trustworthy))
    throw InputError(trustworthy.where, "a tip that is not determined", "one that is");
  const YamlNode& tip = Key(root, "tip");
  point.p_in_tool = ReadVector(Key(tip, "xyz"));
  point.covariance = ReadCovariance(Key(tip, "covariance"));
  const YamlNode& dof = Key(tip, "degrees_of_freedom_together");
  if (dof.kind != YamlNode::Kind::kNull) point.degrees_of_freedom = ReadNumber(dof);
  if (!(point.degrees_of_freedom >= 1.0))
    throw InputError(dof.where, Describe(dof), "degrees of freedom, 1 or more");
  point.tool = ReadTool(Key(root, "tool"));
  AddDoubtOfFit(root, &point.doubts);
  AddDoubtOfOutliers(root, &point.doubts);
  return point;
}

void RequireSameTool(const PivotPoint& point, const Dataset& dataset) {
  if (!point.tool || !dataset.measurement ||
      dataset.measurement->kind != Measurement::Kind::kMarkers)
    return;
  if (!IsSame(*point.tool, dataset.measurement->bodies[static_cast<int>(BodyId::kTool)]))
    throw InputError(point.where,
                     "a tip in the frame of other markers than the dataset's tool has",
                     "a pivoting of the same body: else its frame T is another");
}

}  // namespace hexcal
