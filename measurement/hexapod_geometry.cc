// SPDX-License-Identifier: BSD-3-Clause
#include "measurement/hexapod_geometry.h"

#include <fmt/format.h>

#include <cstring>

#include "config/yaml_number.h"
#include "geometry/rotation_angles.h"
#include "measurement/checked_values.h"

namespace hexcal {
namespace {

// Six points or directions, a column each, as they stand in the file.
Matrix36d ReadSix(const YamlNode& node, std::string_view expected) {
  const std::vector<YamlNode>& items = ReadSequence(node, expected);
  if (items.size() != kNumLegs) throw InputError(node.where, Describe(node), expected);
  Matrix36d columns;
  for (int i = 0; i < kNumLegs; ++i) {
    const std::vector<double> xyz = ReadNumbers(items[i], 3, "a point [x, y, z]");
    columns.col(i) << xyz[0], xyz[1], xyz[2];
  }
  return columns;
}

Matrix36d ReadJoints(const YamlNode& node, std::string_view what, const Units& units) {
  const Matrix36d joints =
      units.length *
      ReadSix(node, fmt::format("{}: six joint centres [x, y, z], leg 1 to 6", what));
  if (AreCollinear(joints))
    throw InputError(node.where,
                     fmt::format("{} all on one line or in one place", what),
                     "joints that span a plate");
  return joints;
}

std::optional<Matrix36d> ReadAxes(const YamlNode* node, std::string_view what) {
  if (node == nullptr) return std::nullopt;
  Matrix36d axes = ReadSix(*node, fmt::format("{}: six directions [x, y, z], leg 1 to 6", what));
  for (int i = 0; i < kNumLegs; ++i)
    axes.col(i) = CheckedDirection(
        axes.col(i), node->items[i].where, fmt::format("the axis of leg {}", i + 1));
  return axes;
}

Eigen::Vector2d ReadLegLimits(const YamlNode& node, const Units& units) {
  const std::vector<double> limits = ReadNumbers(node, 2, "leg_limits [min, max]");
  if (!(limits[0] > 0) || !(limits[0] < limits[1]))
    throw InputError(node.where,
                     fmt::format("leg_limits [{}, {}]", limits[0], limits[1]),
                     "[min, max] with 0 < min < max");
  return units.length * Eigen::Vector2d(limits[0], limits[1]);
}

// Six numbers of Eq. (2); or a pose in full, which is how a home that six numbers do not give to
// the last bit is written.
void ReadHome(const YamlNode& node, const Units& units, HexapodGeometry& geometry) {
  if (node.kind == YamlNode::Kind::kMap) {
    geometry.home = ReadPose(node, units, "home");
    return;
  }
  const std::vector<double> v = ReadNumbers(node, 6, "home [x, y, z, rx, ry, rz]");
  Vector6d pose_vector;
  pose_vector << units.length * Eigen::Vector3d(v[0], v[1], v[2]),
      units.angle * Eigen::Vector3d(v[3], v[4], v[5]);
  geometry.home_vector = pose_vector;
  geometry.home = PoseFromVector(pose_vector);
}

void RefuseEqualLegs(const HexapodGeometry& g, const Location& where) {
  for (int i = 0; i < kNumLegs; ++i)
    for (int j = 0; j < i; ++j)
      if (g.base_joints_in_base.col(i) == g.base_joints_in_base.col(j) &&
          g.platform_joints_in_platform.col(i) == g.platform_joints_in_platform.col(j))
        throw InputError(where,
                         fmt::format("legs {} and {} between the same joints", j + 1, i + 1),
                         "six different legs");
}

std::string WriteSix(const Matrix36d& columns, std::string_view key, const std::string& indent) {
  std::string text = fmt::format("{}{}:\n", indent, key);
  for (int i = 0; i < kNumLegs; ++i)
    text += fmt::format("{}  - {}\n", indent, YamlNumbers(columns.col(i).data(), 3));
  return text;
}

bool SameBits(const double* a, const double* b, int size) {
  return std::memcmp(a, b, size * sizeof(double)) == 0;
}

std::string WriteHome(const HexapodGeometry& geometry) {
  const Pose3d& home = *geometry.home;
  const Vector6d pose_vector =
      geometry.home_vector.value_or(VectorFromPose(home).array() + 0.0);  // -0 becomes 0
  const Pose3d read_back = PoseFromVector(pose_vector);
  const bool is_exact =
      SameBits(read_back.translation.data(), home.translation.data(), 3) &&
      SameBits(read_back.rotation.coeffs().data(), home.rotation.coeffs().data(), 4);
  return is_exact ? YamlNumbers(pose_vector.data(), 6) : WritePose(home);
}

}  // namespace

HexapodGeometry ReadHexapodGeometry(const YamlNode& node, const Units& units) {
  const MapReader map(
      node,
      "hexapod",
      {"base_joints", "platform_joints", "base_axes", "platform_axes", "leg_limits", "home"});
  HexapodGeometry geometry;
  geometry.base_joints_in_base = ReadJoints(map.Required("base_joints"), "base_joints", units);
  geometry.platform_joints_in_platform =
      ReadJoints(map.Required("platform_joints"), "platform_joints", units);
  RefuseEqualLegs(geometry, map.where());
  geometry.base_axes_in_base = ReadAxes(map.Optional("base_axes"), "base_axes");
  geometry.platform_axes_in_platform = ReadAxes(map.Optional("platform_axes"), "platform_axes");
  if (const YamlNode* limits = map.Optional("leg_limits"))
    geometry.leg_limits = ReadLegLimits(*limits, units);
  if (const YamlNode* home = map.Optional("home")) ReadHome(*home, units, geometry);
  return geometry;
}

std::string WriteHexapodGeometry(const HexapodGeometry& geometry, const std::string& indent) {
  std::string text = WriteSix(geometry.base_joints_in_base, "base_joints", indent) +
                     WriteSix(geometry.platform_joints_in_platform, "platform_joints", indent);
  if (geometry.base_axes_in_base)
    text += WriteSix(*geometry.base_axes_in_base, "base_axes", indent);
  if (geometry.platform_axes_in_platform)
    text += WriteSix(*geometry.platform_axes_in_platform, "platform_axes", indent);
  if (geometry.leg_limits)
    text += fmt::format("{}leg_limits: {}\n", indent, YamlNumbers(geometry.leg_limits->data(), 2));
  if (geometry.home) text += fmt::format("{}home: {}\n", indent, WriteHome(geometry));
  return text;
}

Pose3d ReadPose(const YamlNode& node, const Units& units, std::string_view what) {
  const MapReader map(node, what, {"xyz", "quaternion", "rpy"});
  const std::vector<double> xyz = ReadNumbers(map.Required("xyz"), 3, "xyz [x, y, z]");
  const Eigen::Vector3d translation = units.length * Eigen::Vector3d(xyz[0], xyz[1], xyz[2]);
  const YamlNode* quaternion = map.Optional("quaternion");
  const YamlNode* angles = map.Optional("rpy");
  if ((quaternion == nullptr) == (angles == nullptr))
    throw InputError(map.where(),
                     fmt::format("{} quaternion: {} rpy: in {}",
                                 angles == nullptr ? "neither" : "both",
                                 angles == nullptr ? "nor" : "and",
                                 what),
                     "one of them");
  if (quaternion != nullptr) {
    const std::vector<double> q = ReadNumbers(*quaternion, 4, "quaternion [w, x, y, z]");
    return {translation, CheckedQuaternion({q[0], q[1], q[2], q[3]}, quaternion->where)};
  }
  const std::vector<double> rpy = ReadNumbers(*angles, 3, "rpy [rx, ry, rz]");
  Vector6d pose_vector;
  pose_vector << translation, units.angle * Eigen::Vector3d(rpy[0], rpy[1], rpy[2]);
  return PoseFromVector(pose_vector);
}

std::string WritePose(const Pose3d& pose) {
  const Eigen::Quaterniond& q = pose.rotation;
  const double wxyz[] = {q.w(), q.x(), q.y(), q.z()};
  return fmt::format(
      "{{xyz: {}, quaternion: {}}}", YamlNumbers(pose.translation.data(), 3), YamlNumbers(wxyz, 4));
}

}  // namespace hexcal
