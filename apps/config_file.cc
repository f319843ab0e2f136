// SPDX-License-Identifier: BSD-3-Clause
#include "apps/config_file.h"

#include <fmt/format.h>

#include <optional>
#include <string_view>
#include <vector>

#include "apps/flag_value.h"
#include "apps/flags.h"
#include "config/strict_yaml.h"

namespace hexcal {
namespace {

std::vector<std::string_view> Keys(const Command& command) {
  std::vector<std::string_view> keys;
  for (const CommandFlag& flag : command.flags) {
    if (flag.name != "config") keys.push_back(flag.name);
  }
  return keys;
}

// Even a setting that the command line overrides must be right: the file is judged as a whole. The
// flag is put back then.
void Apply(const FlagSpec& spec, const YamlNode& node, bool is_overridden) {
  const bool wants_text = !IsNumber(spec) && !IsSwitch(spec);
  if (node.kind != YamlNode::Kind::kScalar || (node.quoted && !wants_text))
    throw InputError(node.where, Describe(node), ExpectedText(spec));
  const std::string on_command_line = CurrentText(spec);
  if (const std::optional<std::string> expected = SetFlag(spec, node.scalar))
    throw InputError(node.where, fmt::format("'{}' for {}", node.scalar, spec.name), *expected);
  if (is_overridden) SetFlag(spec, on_command_line);
}

}  // namespace

void ApplySettings(const YamlNode& settings,
                   std::string_view what,
                   const std::vector<std::string_view>& keys,
                   const std::set<std::string_view>& given) {
  const MapReader reader(settings, what, keys);
  for (const auto& [key, value] : settings.entries)
    Apply(*FindFlag(key.scalar), value, given.count(key.scalar) > 0);
}

void ApplyConfigFile(const std::string& path, const CommandLine& line) {
  ApplySettings(ParseYamlFile(path),
                fmt::format("the settings of {}", line.command->name),
                Keys(*line.command),
                line.given);
}

}  // namespace hexcal
