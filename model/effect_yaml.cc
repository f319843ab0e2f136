// SPDX-License-Identifier: BSD-3-Clause
#include "model/effect_yaml.h"

#include <fmt/format.h>
#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "config/nearest_word.h"
#include "config/yaml_number.h"
#include "model/data_fault.h"
#include "model/described_effect.h"

namespace hexcal {
namespace {

constexpr double kNotKnown = std::numeric_limits<double>::quiet_NaN();

// An `unknown` has no kind but a description: six coefficients of a power of a driver at a site, or
// nothing but words.
const std::vector<ParameterKind>& DescriptionParameters() {
  static const std::vector<ParameterKind> kinds = {{"coefficients", "", kNumLegs}};
  return kinds;
}

const EffectKind* KindOf(const YamlNode& name) {
  const std::string text = ReadText(name, "the name of an effect");
  const EffectKind* kind = FindEffectKind(text);
  if (kind != nullptr || text == kUnknownEffect) return kind;
  std::vector<std::string_view> known = {kUnknownEffect};
  for (const EffectKind& candidate : EffectKinds()) known.push_back(candidate.name);
  throw InputError(name.where,
                   fmt::format("the effect '{}'", text),
                   fmt::format("an effect that docs/effects.md lists{}", DidYouMean(text, known)));
}

int Carriers(const EffectKind* kind) {
  const bool is_of_legs = kind != nullptr && (kind->site == "leg" || kind->site == "base_joint" ||
                                              kind->site == "platform_joint");
  return is_of_legs || (kind != nullptr && kind->name == "swapped_legs")
             ? kNumLegs
             : std::numeric_limits<int>::max();
}

std::vector<int> ReadIndex(const YamlNode& node, const EffectKind* kind) {
  const int most = Carriers(kind);
  const std::string expected =
      most == kNumLegs ? "different legs, 1 to 6" : "different numbers from 1 on";
  std::vector<int> index;
  for (const YamlNode& item : ReadSequence(node, "a list of numbers")) {
    const long number = ReadInteger(item, expected);
    if (number < 1 || number > most || std::count(index.begin(), index.end(), number) > 0)
      throw InputError(item.where, fmt::format("the number {}", number), expected);
    index.push_back(static_cast<int>(number));
  }
  if (kind != nullptr && kind->name == "swapped_markers" && index.size() != 2)
    throw InputError(node.where, fmt::format("{} markers", index.size()), "two that are swapped");
  return index;
}

double ReadOrNull(const YamlNode& node, bool may_be_null, std::string_view expected) {
  return may_be_null && node.kind == YamlNode::Kind::kNull ? kNotKnown : ReadNumber(node, expected);
}

// The numbers of all parameters; with may_be_null NaN where there is null.
Eigen::VectorXd ReadParameters(const YamlNode& node,
                               const EffectKind* kind,
                               const std::vector<int>& index,
                               bool may_be_null) {
  if (kind == nullptr && node.kind == YamlNode::Kind::kMap && node.entries.empty()) return {};
  const std::vector<ParameterKind>& kinds =
      kind == nullptr ? DescriptionParameters() : kind->parameters;
  std::vector<std::string_view> names;
  for (const ParameterKind& parameter : kinds) names.push_back(parameter.name);
  const MapReader map(node, may_be_null ? "standard_deviation" : "parameters", names);
  std::vector<double> numbers;
  for (const ParameterKind& parameter : kinds) {
    const YamlNode& value = map.Required(parameter.name);
    const std::size_t size =
        parameter.size * (parameter.is_per_marker ? index.size() : std::size_t{1});
    const std::string expected =
        size == 1 ? fmt::format("{} as a number", parameter.name)
                  : fmt::format("{} as a list of {} numbers", parameter.name, size);
    if (size == 1) {
      numbers.push_back(ReadOrNull(value, may_be_null, expected));
      continue;
    }
    const std::vector<YamlNode>& items = ReadSequence(value, expected);
    if (items.size() != size) throw InputError(value.where, Describe(value), expected);
    for (const YamlNode& item : items) numbers.push_back(ReadOrNull(item, may_be_null, expected));
  }
  return Eigen::Map<const Eigen::VectorXd>(numbers.data(),
                                           static_cast<Eigen::Index>(numbers.size()));
}

// What the kind asks for, name and size: all of it must be there.
std::vector<ReferenceKind> ReferencesOf(const EffectKind* kind) {
  if (kind == nullptr) return {{"centre", ""}, {"half_range", ""}, {"power", "1"}};
  if (!kind->IsFault()) return kind->references;
  const FaultKind* fault = FindFaultKind(kind->name);
  CHECK(fault != nullptr) << kind->name;
  if (fault->number.empty()) return {};
  return {{fault->number, "1", fault->size}};
}

EffectReference ReadReference(const MapReader& entry, const EffectKind* kind) {
  const std::vector<ReferenceKind> kinds = ReferencesOf(kind);
  if ((kinds.empty() || kind == nullptr) && !entry.Has("reference")) return {};
  std::vector<std::string_view> names;
  for (const ReferenceKind& reference : kinds) names.push_back(reference.name);
  const MapReader map(entry.Required("reference"), "reference", names);
  EffectReference reference;
  for (const ReferenceKind& asked : kinds) {
    const YamlNode& value = map.Required(asked.name);
    const std::string expected = asked.size == 1
                                     ? fmt::format("{} as a number", asked.name)
                                     : fmt::format("{} as {} numbers", asked.name, asked.size);
    reference[std::string(asked.name)] = asked.size == 1
                                             ? std::vector<double>{ReadNumber(value, expected)}
                                             : ReadNumbers(value, asked.size, expected);
  }
  return reference;
}

std::map<std::string, std::string> ReadFound(const YamlNode& node) {
  if (node.kind != YamlNode::Kind::kMap)
    throw InputError(node.where, Describe(node), "what was found, as words by name");
  std::map<std::string, std::string> found;
  for (const auto& [key, value] : node.entries) found[key.scalar] = ReadText(value);
  return found;
}

void CheckPermutation(const std::vector<double>& permutation, const Location& where) {
  for (int leg = 1; leg <= kNumLegs; ++leg)
    if (std::count(permutation.begin(), permutation.end(), leg) != 1)
      throw InputError(where, "a permutation without each leg once", "the numbers 1 to 6");
}

void CheckFault(const Effect& effect, const Location& where) {
  const FaultKind* fault = FindFaultKind(effect.name);
  if (fault == nullptr) return;
  if (effect.name == "swapped_legs") CheckPermutation(effect.reference.at("permutation"), where);
  if (effect.name == "shifted_rows") {
    const double rows = effect.reference.at("rows")[0];
    if (rows != std::round(rows) || std::abs(rows) > 1e6)
      throw InputError(where, fmt::format("a shift by {} rows", rows), "a whole number");
  }
  if (fault->word.empty()) return;
  const auto word = effect.found.find(std::string(fault->word));
  if (word != effect.found.end() &&
      std::count(fault->words.begin(), fault->words.end(), word->second) > 0)
    return;
  std::string expected = fmt::format("found: with {}:", fault->word);
  for (const std::string_view known : fault->words) expected += fmt::format(" {}", known);
  throw InputError(
      where,
      word == effect.found.end() ? "nothing" : fmt::format("the word '{}'", word->second),
      expected);
}

// A description that corrects something: where, and by what it is driven.
void CheckDescription(const Effect& effect, const Location& where) {
  if (effect.name != kUnknownEffect || effect.parameters.size() == 0) return;
  static const std::vector<std::string> kSites = {"base", "tool", "leg"};
  const auto site = effect.found.find("site"), driver = effect.found.find("driver");
  const bool has_site =
      site != effect.found.end() && std::count(kSites.begin(), kSites.end(), site->second) > 0;
  if (!has_site || driver == effect.found.end() || effect.reference.empty())
    throw InputError(where,
                     "an unknown effect with coefficients that does not say of what",
                     "reference: with centre, half_range and power, and found: with site (base, "
                     "tool, leg) and driver (time, temperature, payload, leg_length, x, y, z, rx, "
                     "ry, rz, or the name of a covariate)");
}

void CheckMarkers(const Effect& effect, const Location& where) {
  const auto markers = effect.reference.find("markers");
  if (markers == effect.reference.end()) return;
  for (const double count : markers->second)
    if (count != std::round(count) || count < 0.0 || count > 1e6)
      throw InputError(where, fmt::format("{} markers", count), "how many markers a body has");
  const double most = markers->second[0] + markers->second[1];
  for (const int number : effect.index)
    if (number > most)
      throw InputError(where, fmt::format("marker {}", number), fmt::format("1 to {}", most));
}

Effect ReadEffect(const YamlNode& node) {
  const MapReader entry(
      node,
      "an effect",
      {"name", "index", "parameters", "standard_deviation", "reference", "found"});
  const YamlNode& name = entry.Required("name");
  const EffectKind* kind = KindOf(name);
  Effect effect;
  effect.name = name.scalar;
  if (const YamlNode* index = entry.Optional("index")) effect.index = ReadIndex(*index, kind);
  if (effect.name == "swapped_markers" && effect.index.empty()) entry.Required("index");
  const bool has_parameters = kind != nullptr && !kind->parameters.empty();
  if (has_parameters || entry.Has("parameters"))
    effect.parameters = ReadParameters(entry.Required("parameters"), kind, effect.index, false);
  if (const YamlNode* deviation = entry.Optional("standard_deviation"))
    effect.standard_deviation = ReadParameters(*deviation, kind, effect.index, true);
  effect.reference = ReadReference(entry, kind);
  if (const YamlNode* found = entry.Optional("found")) effect.found = ReadFound(*found);
  CheckFault(effect, node.where);
  CheckMarkers(effect, node.where);
  CheckDescription(effect, node.where);
  return effect;
}

std::string Number(double value) { return std::isnan(value) ? "null" : YamlNumber(value); }

std::string Numbers(const double* values, int size, bool as_list) {
  if (!as_list) return Number(values[0]);
  std::string text = "[";
  for (int i = 0; i < size; ++i) text += (i == 0 ? "" : ", ") + Number(values[i]);
  return text + "]";
}

std::string WriteParameters(const Effect& effect, const Eigen::VectorXd& numbers) {
  if (numbers.size() == 0) return "{}";
  const EffectKind* kind = FindEffectKind(effect.name);
  std::string text;
  int offset = 0;
  for (const ParameterKind& parameter :
       kind == nullptr ? DescriptionParameters() : kind->parameters) {
    const int size =
        parameter.size * (parameter.is_per_marker ? static_cast<int>(effect.index.size()) : 1);
    text += fmt::format("{}{}: {}",
                        text.empty() ? "" : ", ",
                        parameter.name,
                        Numbers(numbers.data() + offset, size, size != 1));
    offset += size;
  }
  CHECK_EQ(offset, numbers.size()) << effect.name;
  return "{" + text + "}";
}

std::string Quoted(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + "\"";
}

std::string WriteEffect(const Effect& effect) {
  std::string text = fmt::format("{{name: {}, index: [", effect.name);
  for (std::size_t i = 0; i < effect.index.size(); ++i)
    text += fmt::format("{}{}", i == 0 ? "" : ", ", effect.index[i]);
  text += fmt::format("], parameters: {}", WriteParameters(effect, effect.parameters));
  if (effect.standard_deviation.size() > 0)
    text += ", standard_deviation: " + WriteParameters(effect, effect.standard_deviation);
  std::string reference, found;
  for (const auto& [name, numbers] : effect.reference)
    reference +=
        fmt::format("{}{}: {}",
                    reference.empty() ? "" : ", ",
                    name,
                    Numbers(numbers.data(), static_cast<int>(numbers.size()), numbers.size() != 1));
  for (const auto& [name, word] : effect.found)
    found += fmt::format("{}{}: {}", found.empty() ? "" : ", ", name, Quoted(word));
  if (!reference.empty()) text += fmt::format(", reference: {{{}}}", reference);
  if (!found.empty()) text += fmt::format(", found: {{{}}}", found);
  return text + "}";
}

}  // namespace

std::vector<Effect> ReadEffects(const YamlNode& node) {
  std::vector<Effect> effects;
  for (const YamlNode& item : ReadSequence(node, "a list of effects"))
    effects.push_back(ReadEffect(item));
  return effects;
}

std::string WriteEffects(const std::vector<Effect>& effects) {
  if (effects.empty()) return "effects: []\n";
  std::string text = "effects:\n";
  for (const Effect& effect : effects) text += fmt::format("  - {}\n", WriteEffect(effect));
  return text;
}

}  // namespace hexcal
