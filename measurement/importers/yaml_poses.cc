// SPDX-License-Identifier: BSD-3-Clause
#include "measurement/importers/yaml_poses.h"

#include <fmt/format.h>

#include <filesystem>

#include "measurement/checked_values.h"
#include "measurement/labels.h"

namespace hexcal {
namespace {

namespace fs = std::filesystem;

constexpr YamlLimits kPoseFile = {8, 1000, 64 << 10};

const YamlNode* Find(const YamlNode& map, std::string_view key) {
  for (const auto& [name, value] : map.entries)
    if (name.scalar == key) return &value;
  return nullptr;
}

const YamlNode& Required(const YamlNode& map, std::string_view key, std::string_view expected) {
  if (const YamlNode* value = Find(map, key)) return *value;
  throw InputError(map.where, fmt::format("no key '{}'", key), expected);
}

std::string TextOr(const YamlNode& map, std::string_view key, const char* otherwise) {
  const YamlNode* value = Find(map, key);
  return value == nullptr || value->kind != YamlNode::Kind::kScalar ? otherwise : value->scalar;
}

// In the folder of the list, links followed.
std::string PoseFile(const YamlNode& node, const fs::path& folder) {
  const std::string text = ReadText(node, "the path of a pose file");
  std::error_code error;
  const fs::path real = fs::canonical(folder / fs::path(text), error);
  if (error)
    throw InputError(node.where, fmt::format("no file {}", Quoted(text)), "an existing pose file");
  const fs::path inside = real.lexically_relative(fs::canonical(folder));
  if (fs::path(text).is_absolute() || inside.empty() || *inside.begin() == "..")
    throw InputError(node.where,
                     fmt::format("the path {}", Quoted(text)),
                     "a file in the folder of the list, or below");
  return (folder / fs::path(text)).string();
}

}  // namespace

Pose3d ReadRosPose(const YamlNode& node) {
  constexpr const char* kExpected = "a pose {x, y, z, qx, qy, qz, qw}";
  const auto number = [&](std::string_view key) {
    return ReadNumber(Required(node, key, kExpected), fmt::format("a number for {}", key));
  };
  const Eigen::Vector4d wxyz(number("qw"), number("qx"), number("qy"), number("qz"));
  return {{number("x"), number("y"), number("z")}, CheckedQuaternion(wxyz, node.where)};
}

StoredTransform ReadEasyHandeye(const std::string& path) {
  constexpr const char* kExpected = "an easy_handeye calibration: parameters and transformation";
  const YamlNode root = ParseYamlFile(path, kPoseFile);
  const YamlNode& parameters = Required(root, "parameters", kExpected);
  StoredTransform stored;
  stored.path = path;
  stored.is_tool = ReadBool(Required(parameters, "eye_on_hand", kExpected));
  stored.parent =
      TextOr(parameters, stored.is_tool ? "robot_effector_frame" : "robot_base_frame", "");
  stored.child = TextOr(parameters, "tracking_base_frame", "");
  stored.parent_from_child = ReadRosPose(Required(root, "transformation", kExpected));
  return stored;
}

Recording ReadIndustrialCalibration(const std::string& path, const ImportOptions&) {
  constexpr const char* kExpected = "a list 'data:' of entries with 'pose: FILE.yaml'";
  const YamlNode root = ParseYamlFile(path);
  const fs::path parent = fs::path(path).parent_path();
  const fs::path folder = parent.empty() ? fs::path(".") : parent;
  Recording recording;
  recording.path = path;
  recording.bodies.push_back({"poses", {}, {}});
  recording.reading = "m, quaternions scalar last";
  for (const YamlNode& entry : ReadSequence(Required(root, "data", kExpected), kExpected)) {
    CheckReadings(recording.rows, 1, entry.where);
    const YamlNode& file = Required(entry, "pose", kExpected);
    const YamlNode pose = ParseYamlFile(PoseFile(file, folder), kPoseFile);
    recording.bodies.front().poses.emplace_back(ReadRosPose(pose));
    recording.labels.push_back(file.scalar);
    recording.lines.push_back(file.where.line);
    ++recording.rows;
  }
  if (recording.rows == 0) throw InputError(root.where, "an empty list", kExpected);
  return recording;
}

}  // namespace hexcal
