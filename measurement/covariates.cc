// SPDX-License-Identifier: BSD-3-Clause
#include "measurement/covariates.h"

#include <fmt/format.h>

#include <array>

#include "measurement/labels.h"
#include "measurement/pose_columns.h"

namespace hexcal {
namespace {

constexpr const char* kAllUnits =
    "s, min, h, degC, K, kg, N, m, mm, m/s, mm/s, rad, deg, rad/s, "
    "deg/s or 1";

// A name that has a meaning, and the units that it may be in.
struct Meaning {
  std::string_view name;
  std::string_view si_symbol;
  std::string_view units_in_words;
};

constexpr std::array<Meaning, 18> kMeanings = {{
    {"time", "s", "s, min or h"},
    {"temperature", "degC", "degC"},
    {"payload", "kg", "kg"},
    {"payload_x", "m", "m or mm"},
    {"payload_y", "m", "m or mm"},
    {"payload_z", "m", "m or mm"},
    {"vx", "m/s", "m/s or mm/s"},
    {"vy", "m/s", "m/s or mm/s"},
    {"vz", "m/s", "m/s or mm/s"},
    {"wx", "rad/s", "rad/s or deg/s"},
    {"wy", "rad/s", "rad/s or deg/s"},
    {"wz", "rad/s", "rad/s or deg/s"},
    {"direction_1", "1", "1"},
    {"direction_2", "1", "1"},
    {"direction_3", "1", "1"},
    {"direction_4", "1", "1"},
    {"direction_5", "1", "1"},
    {"direction_6", "1", "1"},
}};

const Meaning* FindMeaning(std::string_view name) {
  for (const Meaning& meaning : kMeanings)
    if (meaning.name == name) return &meaning;
  return nullptr;
}

Unit ReadUnit(const YamlNode& node, const std::string& name) {
  if (node.kind != YamlNode::Kind::kScalar)
    throw InputError(
        node.where, Describe(node), fmt::format("the unit of {}: {}", name, kAllUnits));
  const std::optional<Unit> unit = FindCovariateUnit(node.scalar);
  if (!unit)
    throw InputError(
        node.where, fmt::format("the unit {} of {}", Quoted(node.scalar), name), kAllUnits);
  const Meaning* meaning = FindMeaning(name);
  if (meaning != nullptr && (unit->si_symbol != meaning->si_symbol ||
                             (meaning->name == "temperature" && unit->symbol != "degC")))
    throw InputError(node.where,
                     fmt::format("the unit {} of {}", Quoted(node.scalar), name),
                     meaning->units_in_words);
  return *unit;
}

}  // namespace

bool HasMeaning(std::string_view name) { return FindMeaning(name) != nullptr; }

std::vector<CovariateDeclaration> ReadCovariates(const YamlNode* node) {
  std::vector<CovariateDeclaration> covariates;
  if (node == nullptr) return covariates;
  if (node->kind != YamlNode::Kind::kMap)
    throw InputError(node->where, Describe(*node), "a mapping of columns to units {time: s, ...}");
  for (const auto& [key, unit] : node->entries) {
    CheckLabel(key.scalar, key.where, "name of a covariate");
    if (PoseColumns::IsReserved(key.scalar))
      throw InputError(key.where,
                       fmt::format("a covariate called {}", Quoted(key.scalar)),
                       "a name that no column of the pose has");
    covariates.push_back({key.scalar, ReadUnit(unit, key.scalar), key.where});
  }
  return covariates;
}

void CheckCovariateValue(const std::string& name, double value, const Location& where) {
  if (name.rfind("direction_", 0) == 0 && FindMeaning(name) != nullptr && value != -1 &&
      value != 0 && value != 1)
    throw InputError(where, fmt::format("{} for {}", value, name), "-1, 0 or 1");
}

}  // namespace hexcal
