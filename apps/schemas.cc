// SPDX-License-Identifier: BSD-3-Clause
#include "apps/schemas.h"

#include <fmt/format.h>
#include <glog/logging.h>

#include <algorithm>
#include <string>

#include "apps/schema_parts.h"
#include "apps/schema_texts.h"

namespace hexcal {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view kPrefix = "#/$defs/";

void CollectReferences(const Json& schema, std::vector<std::string>& names) {
  if (schema.is_object() && schema.contains("$ref") && schema["$ref"].is_string()) {
    const std::string name = schema["$ref"].get<std::string>().substr(kPrefix.size());
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  if (!schema.is_structured()) return;
  for (const Json& part : schema) CollectReferences(part, names);
}

const Json& Definitions() {
  static const Json definitions = [] {
    Json all = Json::parse(CommonSchemaText());
    all.update(NameSchemas());
    all["effect"] = EffectSchema();
    for (const char* command : {"calibrate", "discover"})
      all[fmt::format("{}_settings", command)] = BatchSettingsSchema(*FindCommand(command));
    return all;
  }();
  return definitions;
}

// Adds what the schema refers to, and what that refers to.
void AddDefinitions(Json& schema) {
  std::vector<std::string> names;
  CollectReferences(schema, names);
  Json own = schema.value("$defs", Json::object());
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string name = names[i];
    if (own.contains(name)) continue;
    CHECK(Definitions().contains(name)) << name;
    own[name] = Definitions()[name];
    CollectReferences(own[name], names);
  }
  schema.erase("$defs");
  if (!own.empty()) schema["$defs"] = own;
}

}  // namespace

const std::vector<SchemaInfo>& Schemas() {
  static const std::vector<SchemaInfo> schemas = {
      {"dataset", "dataset.yaml, which every command reads", &DatasetSchemaText},
      {"model", "model.yaml, a calibrated machine", &ModelSchemaText},
      {"settings", "--config files, of all commands or of one", nullptr},
      {"requirement", "--requirement of audit", &RequirementSchemaText},
      {"columns", "--map and --robot_map of import", &ColumnsSchemaText},
      {"pivoting", "what pivot reads", &PivotingSchemaText},
      {"batch", "the manifest of batch", &BatchSchemaText},
      {"result", "result.json of calibrate, audit and discover", &ResultSchemaText},
      {"discovery", "discovery.json", &DiscoverySchemaText},
      {"audit", "audit.json", &AuditSchemaText},
      {"compare", "compare.json", &CompareSchemaText},
      {"plan", "plan.json", &PlanSchemaText},
      {"pivot", "pivot.json", &PivotSchemaText},
      {"run", "run.json, beside each of them", &RunSchemaText},
      {"written", "--json of commands that only make files", &WrittenSchemaText},
      {"batch-counts", "--json of batch", &BatchCountsSchemaText},
      {"history_list", "--json of history list", &HistoryListSchemaText},
      {"history_record", "--json of history show", &HistoryRecordSchemaText},
      {"history_trend", "--json of history trend", &HistoryTrendSchemaText},
      {"history_check", "--json of history verify", &HistoryCheckSchemaText}};
  return schemas;
}

const SchemaInfo* FindSchema(std::string_view name) {
  const std::vector<SchemaInfo>& schemas = Schemas();
  const auto found = std::find_if(
      schemas.begin(), schemas.end(), [name](const SchemaInfo& own) { return own.name == name; });
  return found == schemas.end() ? nullptr : &*found;
}

Json WholeSchema(const SchemaInfo& info, const Command* command) {
  Json schema = {{"$schema", "https://json-schema.org/draft/2020-12/schema"},
                 {"$id", fmt::format("urn:hexcal:{}:1", info.name)}};
  schema.update(info.text == nullptr ? SettingsSchema(command) : Json::parse(info.text()));
  AddDefinitions(schema);
  return schema;
}

}  // namespace hexcal
