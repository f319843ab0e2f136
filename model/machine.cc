// SPDX-License-Identifier: BSD-3-Clause
#include "model/machine.h"

#include <fmt/format.h>

#include "config/strict_yaml.h"

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

std::string NameOfEffect(const YamlNode& effect) {
  for (const auto& [key, value] : effect.entries)
    if (key.scalar == "name" && value.kind == YamlNode::Kind::kScalar)
      return fmt::format("the effect '{}'", value.scalar);
  return fmt::format("{} among the effects", Describe(effect));
}

// An effect that is left out would make every prediction wrong without a word.
void RefuseEffects(const MapReader& map) {
  constexpr std::string_view kExpected =
      "a model of base, tool and hexapod alone: this version of hexcal knows no effects";
  if (const YamlNode* effects = map.Optional("effects")) {
    const std::vector<YamlNode>& items = ReadSequence(*effects, "a list of effects");
    if (!items.empty()) throw InputError(items[0].where, NameOfEffect(items[0]), kExpected);
  }
  if (const YamlNode* pose_map = map.Optional("pose_map"))
    throw InputError(pose_map->where, "a pose_map", kExpected);
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
  RefuseEffects(map);
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
  return text + "effects: []\n";
}

}  // namespace hexcal
