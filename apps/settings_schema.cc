// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <cmath>
#include <string>

#include "apps/flag_value.h"
#include "apps/flags.h"
#include "apps/help.h"
#include "apps/schema_parts.h"

namespace hexcal {
namespace {

using Json = nlohmann::ordered_json;

Json NumberSchema(const FlagSpec& spec) {
  Json schema = {{"type", IsWholeNumber(spec) ? "integer" : "number"}};
  if (std::isfinite(spec.low))
    schema[spec.low_excluded ? "exclusiveMinimum" : "minimum"] = spec.low;
  if (std::isfinite(spec.high)) schema["maximum"] = spec.high;
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

}  // namespace hexcal
