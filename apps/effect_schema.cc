// SPDX-License-Identifier: BSD-3-Clause
#include <string>
#include <vector>

#include "apps/schema_parts.h"
#include "estimator/method.h"
#include "geometry/rotation_order.h"
#include "model/data_fault.h"
#include "model/effect.h"

namespace hexcal {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kLegs = 6;

Json Object(Json properties, Json required) {
  return {{"type", "object"},
          {"properties", std::move(properties)},
          {"required", std::move(required)},
          {"additionalProperties", false}};
}

Json ListOf(const Json& items, std::size_t fewest, std::size_t most) {
  return {{"type", "array"}, {"items", items}, {"minItems", fewest}, {"maxItems", most}};
}

// One number alone, or a list of size; per marker, of as many as there are markers.
Json Numbers(const ParameterKind& kind, const Json& number) {
  if (kind.is_per_marker) return {{"type", "array"}, {"items", number}, {"minItems", kind.size}};
  const auto size = static_cast<std::size_t>(kind.size);
  return kind.size == 1 ? number : ListOf(number, size, size);
}

Json Parameters(const std::vector<ParameterKind>& kinds, const Json& number) {
  Json properties = Json::object(), required = Json::array();
  for (const ParameterKind& kind : kinds) {
    properties[std::string(kind.name)] = Numbers(kind, number);
    if (!kind.unit.empty())
      properties[std::string(kind.name)]["description"] = std::string(kind.unit);
    required.push_back(std::string(kind.name));
  }
  return Object(properties, required);
}

// A number that an effect refers to, where not every number will do.
Json Reference(const ReferenceKind& kind) {
  constexpr int kMost = 1'000'000;
  Json number = {{"type", "number"}};
  if (kind.name == "markers") number = {{"type", "integer"}, {"minimum", 0}, {"maximum", kMost}};
  if (kind.name == "rows") number = {{"type", "integer"}, {"minimum", -kMost}, {"maximum", kMost}};
  if (kind.name == "permutation")
    number = {{"type", "integer"}, {"minimum", 1}, {"maximum", kLegs}};
  const auto size = static_cast<std::size_t>(kind.size);
  Json schema = size == 1 ? number : ListOf(number, size, size);
  if (kind.name == "permutation") schema["uniqueItems"] = true;
  return schema;
}

Json References(const std::vector<ReferenceKind>& kinds) {
  Json properties = Json::object(), required = Json::array();
  for (const ReferenceKind& kind : kinds) {
    properties[std::string(kind.name)] = Reference(kind);
    required.push_back(std::string(kind.name));
  }
  return Object(properties, required);
}

Json Words(std::string_view name, const std::vector<std::string_view>& words) {
  Json choices = Json::array();
  for (const std::string_view word : words) choices.push_back(std::string(word));
  return {{"properties", {{std::string(name), {{"enum", choices}}}}},
          {"required", {std::string(name)}}};
}

bool IsOfLegs(const EffectKind& kind) {
  return kind.site == "leg" || kind.site == "base_joint" || kind.site == "platform_joint" ||
         kind.name == "swapped_legs";
}

Json IndexOf(const EffectKind& kind) {
  Json index = {{"uniqueItems", true}};
  if (IsOfLegs(kind)) index["items"] = {{"maximum", kLegs}};
  if (kind.name == "swapped_markers") index["minItems"] = index["maxItems"] = 2;
  return index;
}

// What holds for an effect of this kind beyond what holds for all.
Json ThenOf(const EffectKind& kind) {
  const Json number = {{"type", "number"}}, maybe = {{"type", {"number", "null"}}};
  Json properties = {{"index", IndexOf(kind)},
                     {"parameters", Parameters(kind.parameters, number)},
                     {"standard_deviation", Parameters(kind.parameters, maybe)}};
  Json required = Json::array();
  if (!kind.parameters.empty()) required.push_back("parameters");
  if (kind.name == "swapped_markers") required.push_back("index");
  std::vector<ReferenceKind> references = kind.references;
  if (const FaultKind* fault = FindFaultKind(kind.name)) {
    if (!fault->number.empty()) references = {{fault->number, "1", fault->size}};
    if (!fault->word.empty()) {
      properties["found"] = Words(fault->word, fault->words);
      required.push_back("found");
    }
  }
  properties["reference"] = References(references);
  if (!references.empty()) required.push_back("reference");
  Json then = {{"properties", properties}};
  if (!kind.cause.empty())
    then = {{"description", std::string(kind.cause)}, {"properties", properties}};
  if (!required.empty()) then["required"] = required;
  return then;
}

// What was found but has no name: with coefficients it says of what they are.
Json ThenOfUnknown() {
  const Json coefficients = {{"coefficients", {{"$ref", "#/$defs/six"}}}};
  const Json reference = References({{"centre", ""}, {"half_range", ""}, {"power", "1"}});
  Json with = {{"required", {"reference", "found"}}};
  with["properties"]["found"] = Words("site", {"base", "tool", "leg"});
  with["properties"]["found"]["required"].push_back("driver");
  return {
      {"properties",
       {{"parameters", Object(coefficients, Json::array())}, {"reference", reference}}},
      {"if",
       {{"properties", {{"parameters", {{"minProperties", 1}}}}}, {"required", {"parameters"}}}},
      {"then", with}};
}

Json CaseOf(std::string_view name, const Json& then) {
  return {
      {"if", {{"properties", {{"name", {{"const", std::string(name)}}}}}, {"required", {"name"}}}},
      {"then", then}};
}

}  // namespace

Json EffectSchema() {
  const Json properties = {
      {"name", {{"$ref", "#/$defs/effect_name"}}},
      {"index", {{"$ref", "#/$defs/index"}}},
      {"parameters", {{"type", "object"}}},
      {"standard_deviation", {{"type", "object"}}},
      {"reference", {{"type", "object"}}},
      {"found", {{"type", "object"}, {"additionalProperties", {{"$ref", "#/$defs/text"}}}}}};
  Json effect = Object(properties, {"name"});
  for (const EffectKind& kind : EffectKinds())
    effect["allOf"].push_back(CaseOf(kind.name, ThenOf(kind)));
  effect["allOf"].push_back(CaseOf(kUnknownEffect, ThenOfUnknown()));
  return effect;
}

Json NameSchemas() {
  Json effects = Json::array(), methods = Json::array(), orders = Json::array();
  for (const EffectKind& kind : EffectKinds()) effects.push_back(std::string(kind.name));
  effects.push_back(std::string(kUnknownEffect));
  for (const MethodInfo& method : kMethods) methods.push_back(std::string(method.name));
  for (const std::string_view order : kRotationOrders) orders.push_back(std::string(order));
  return {{"effect_name", {{"enum", effects}}},
          {"method_name", {{"enum", methods}}},
          {"rotation_order", {{"enum", orders}}}};
}

}  // namespace hexcal
