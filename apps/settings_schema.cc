// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include "apps/batch_settings.h"
#include "apps/flag_value.h"
#include "apps/flags.h"
#include "apps/help.h"
#include "apps/schema_parts.h"

namespace hexcal {
namespace {

using Json = nlohmann::ordered_json;

Json NumberSchema(const FlagSpec& spec) {
  const bool is_whole = IsWholeNumber(spec);
  const auto end = [is_whole](double value) {
    return is_whole ? Json(static_cast<std::int64_t>(value)) : Json(value);
  };
  Json schema = {{"type", is_whole ? "integer" : "number"}};
  if (std::isfinite(spec.low))
    schema[spec.low_excluded ? "exclusiveMinimum" : "minimum"] = end(spec.low);
  if (std::isfinite(spec.high))
    schema["maximum"] = end(spec.high);
  else if (is_whole)
    schema["maximum"] = std::numeric_limits<std::int64_t>::max();
  return schema;
}

Json ValueSchema(const FlagSpec& spec) {
  if (IsSwitch(spec)) return {{"type", "boolean"}};
  if (IsNumber(spec)) return NumberSchema(spec);
  if (spec.choices.empty()) return {{"type", {"string", "number", "boolean"}}, {"minLength", 1}};
  Json choices = Json::array();
  for (const std::string_view choice : spec.choices) choices.push_back(std::string(choice));
  return {{"enum", choices}};
}

void Add(const CommandFlag& flag, Json& properties) {
  const std::string name(flag.name);
  if (flag.name == "config" || properties.contains(name)) return;
  Json schema = {{"description", FlagText(flag)}};
  schema.update(ValueSchema(*FindFlag(flag.name)));
  properties[name] = std::move(schema);
}

}  // namespace

Json SettingsSchema(const Command* command) {
  Json properties = Json::object();
  for (const Command& each : Commands()) {
    if (command != nullptr && each.name != command->name) continue;
    for (const CommandFlag& flag : each.flags) Add(flag, properties);
  }
  const std::string of = command == nullptr ? "" : fmt::format(" of {}", command->name);
  return {{"title", fmt::format("settings{}, for --config (docs/commands.md)", of)},
          {"type", "object"},
          {"properties", properties},
          {"additionalProperties", false}};
}

Json BatchSettingsSchema(const Command& command) {
  Json properties = Json::object();
  Json together = Json::object();
  for (const std::string_view name : BatchSettings(command.name)) {
    Add(*command.FindFlag(name), properties);
    const std::string_view other = FindFlag(name)->together_with;
    if (!other.empty()) together[std::string(name)] = {std::string(other)};
  }
  return {{"type", "object"},
          {"properties", properties},
          {"dependentRequired", together},
          {"additionalProperties", false}};
}

}  // namespace hexcal
