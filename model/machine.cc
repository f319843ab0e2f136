// SPDX-License-Identifier: BSD-3-Clause
#include "model/machine.h"

#include <fmt/format.h>

#include "config/strict_yaml.h"
#include "model/effect_yaml.h"
#include "model/pose_map_yaml.h"

namespace hexcal {
namespace {

constexpr std::string_view kFormat = "hexcal/model/1";

// Before anything else: a file of another version may have other keys.
void CheckFormat(const YamlNode& root) {
  for (const auto& [key, value] : root.entries) {
    if (key.scalar != "format") continue;
    const std::string format = ReadText(value, kFormat);
    if (format != kFormat)
      throw InputError(value.where, fmt::format("the format '{}'", format), kFormat);
  }
}

std::string ReadDatasetName(const YamlNode& node) {
  std::string name = ReadText(node, "the name of a dataset");
  const bool has_only_allowed =
      name.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789._-") ==
      std::string::npos;
  if (has_only_allowed && !name.empty()) return name;
  throw InputError(node.where,
                   fmt::format("the text '{}'", name),
                   "the name of a dataset: letters, digits, '.', '_' and '-' only");
}

}  // namespace

Machine ReadMachine(const std::string& path) {
  const YamlNode root = ParseYamlFile(path);
  CheckFormat(root);
  const MapReader map(root,
                      "the model",
                      {"format",
                       "dataset",
                       "world_from_base",
                       "platform_from_tool",
                       "world_from_tracker",
                       "hexapod",
                       "effects",
                       "pose_map"});
  map.Required("format");
  const Units si;
  Machine machine;
  machine.dataset = ReadDatasetName(map.Required("dataset"));
  machine.world_from_base = ReadPose(map.Required("world_from_base"), si, "world_from_base");
  machine.platform_from_tool =
      ReadPose(map.Required("platform_from_tool"), si, "platform_from_tool");
  if (const YamlNode* tracker = map.Optional("world_from_tracker"))
    machine.world_from_tracker = ReadPose(*tracker, si, "world_from_tracker");
  if (const YamlNode* hexapod = map.Optional("hexapod"))
    machine.hexapod = ReadHexapodGeometry(*hexapod, si);
  if (const YamlNode* effects = map.Optional("effects")) machine.effects = ReadEffects(*effects);
  if (const YamlNode* pose_map = map.Optional("pose_map"))
    machine.pose_map = ReadPoseMap(*pose_map);
  return machine;
}

std::string WriteMachine(const Machine& machine) {
  // Quoted: a dataset may be called 1 or null.
  std::string text = fmt::format("format: {}\ndataset: \"{}\"\n", kFormat, machine.dataset);
  text += fmt::format("world_from_base: {}\n", WritePose(machine.world_from_base));
  text += fmt::format("platform_from_tool: {}\n", WritePose(machine.platform_from_tool));
  if (machine.world_from_tracker)
    text += fmt::format("world_from_tracker: {}\n", WritePose(*machine.world_from_tracker));
  if (machine.hexapod) text += "hexapod:\n" + WriteHexapodGeometry(*machine.hexapod, "  ");
  text += WriteEffects(machine.effects);
  if (machine.pose_map) text += "pose_map:\n" + WritePoseMap(*machine.pose_map, "  ");
  return text;
}

}  // namespace hexcal
