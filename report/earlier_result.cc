// SPDX-License-Identifier: BSD-3-Clause
#include "report/earlier_result.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "config/strict_yaml.h"
#include "geometry/covariance.h"

namespace hexcal {
namespace {

// JSON is read as the YAML that it is, for the line numbers. nullptr: no such key.
const YamlNode* Find(const YamlNode& map, std::string_view key) {
  if (map.kind != YamlNode::Kind::kMap)
    throw InputError(map.where, Describe(map), "a result.json of hexcal");
  for (const auto& [name, value] : map.entries)
    if (name.scalar == key) return &value;
  return nullptr;
}

const YamlNode& Key(const YamlNode& map, std::string_view key) {
  if (const YamlNode* value = Find(map, key)) return *value;
  throw InputError(map.where, fmt::format("no key '{}'", key), "a result.json of hexcal");
}

// The matrix says the same as position and quaternion, where it is there.
void RequireSame(const YamlNode& matrix, const Pose3d& pose) {
  constexpr double kTolerance = 1e-6;
  Eigen::Matrix4d expected = Eigen::Matrix4d::Identity();
  expected.topLeftCorner<3, 3>() = pose.rotation.toRotationMatrix();
  expected.topRightCorner<3, 1>() = pose.translation;
  const auto& rows = ReadSequence(matrix, "a matrix, 4 rows of 4 numbers");
  if (rows.size() != 4) throw InputError(matrix.where, Describe(matrix), "4 rows of 4 numbers");
  for (int i = 0; i < 4; ++i) {
    const auto numbers = ReadNumbers(rows[static_cast<std::size_t>(i)], 4, "four numbers");
    for (int j = 0; j < 4; ++j) {
      const double found = numbers[static_cast<std::size_t>(j)];
      if (std::abs(found - expected(i, j)) <= kTolerance * std::max(1.0, std::abs(expected(i, j))))
        continue;
      throw InputError(rows[static_cast<std::size_t>(i)].where,
                       fmt::format("{} in row {} and column {} of the matrix", found, i + 1, j + 1),
                       fmt::format("{}, as xyz and quaternion say", expected(i, j)));
    }
  }
}

Pose3d ReadMount(const YamlNode& node) {
  const auto xyz = ReadNumbers(Key(node, "xyz"), 3, "xyz, three numbers");
  const auto q = ReadNumbers(Key(node, "quaternion"), 4, "a quaternion, four numbers");
  const Eigen::Quaterniond rotation(q[0], q[1], q[2], q[3]);
  if (!(std::abs(rotation.norm() - 1.0) < 1e-3))
    throw InputError(Key(node, "quaternion").where, "a quaternion of another length", "length one");
  const Pose3d pose{Eigen::Vector3d(xyz[0], xyz[1], xyz[2]), rotation.normalized()};
  if (const YamlNode* matrix = Find(node, "matrix")) RequireSame(*matrix, pose);
  return pose;
}

// Of the poses that were used; nothing where the result does not say so of all of them.
std::vector<std::string> ReadReadings(const YamlNode& root) {
  std::vector<std::string> all;
  const YamlNode* poses = Find(root, "poses");
  if (poses == nullptr) return all;
  for (const YamlNode& pose : ReadSequence(*poses, "a list of poses")) {
    const YamlNode* readings = Find(pose, "readings");
    if (readings == nullptr) return {};
    if (ReadNumber(Key(pose, "weight")) > 0.0) all.push_back(ReadText(*readings));
  }
  return all;
}

}  // namespace

EarlierResult ReadEarlierResult(const std::string& path) {
  constexpr std::string_view kFormat = "hexcal/result/1";
  const YamlNode root = ParseYamlFile(path);
  const YamlNode& format = Key(root, "format");
  if (ReadText(format, kFormat) != kFormat)
    throw InputError(format.where, Describe(format), fmt::format("'{}'", kFormat));
  EarlierResult result;
  result.path = path;
  result.dataset = ReadText(Key(root, "dataset"));
  result.mounts = {ReadMount(Key(root, "world_from_base")),
                   ReadMount(Key(root, "platform_from_tool"))};
  const YamlNode& covariance = Key(root, "covariance");
  const auto& rows = ReadSequence(covariance, "12 rows of 12 numbers");
  if (rows.size() != 12) throw InputError(covariance.where, Describe(covariance), "12 rows");
  for (int i = 0; i < 12; ++i) {
    const auto& row = ReadSequence(rows[i], "12 numbers");
    if (row.size() != 12) throw InputError(rows[i].where, Describe(rows[i]), "12 numbers");
    result.determined[i] = row[i].kind != YamlNode::Kind::kNull;
    for (int j = 0; j < 12; ++j)
      if (row[j].kind != YamlNode::Kind::kNull) result.covariance(i, j) = ReadNumber(row[j]);
  }
  // Of what was not determined nothing is known, whatever stands beside it.
  for (int i = 0; i < 12; ++i)
    if (!result.determined[i]) {
      result.covariance.row(i).setZero();
      result.covariance.col(i).setZero();
    }
  if (!IsCovariance(result.covariance))
    throw InputError(
        covariance.where, "a matrix that is no covariance", "a symmetric, positive one");
  result.readings = ReadReadings(root);
  return result;
}

}  // namespace hexcal
