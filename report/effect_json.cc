// SPDX-License-Identifier: BSD-3-Clause
#include "report/effect_json.h"

#include <cmath>

#include "report/effect_numbers.h"

namespace hexcal {
namespace {

using Json = nlohmann::ordered_json;

// One number alone, a list, or a list of rows.
template <typename Take>
Json Arranged(const EffectParameter& parameter, Take take) {
  if (parameter.columns == 0) return take(parameter.numbers.front());
  Json list = Json::array();
  for (const EffectNumber& number : parameter.numbers) list.push_back(take(number));
  if (static_cast<int>(parameter.numbers.size()) <= parameter.columns) return list;
  Json rows = Json::array();
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (i % parameter.columns == 0) rows.push_back(Json::array());
    rows.back().push_back(list[i]);
  }
  return rows;
}

template <typename Take>
Json ByName(const Effect& effect, Take take) {
  Json object = Json::object();
  for (const EffectParameter& parameter : ParametersOf(effect, {}))
    object[parameter.name] = Arranged(parameter, take);
  return object;
}

}  // namespace

Json JsonParameters(const Effect& effect) {
  return ByName(effect, [](const EffectNumber& number) { return Json(number.value); });
}

Json JsonDeviations(const Effect& effect) {
  return ByName(effect, [](const EffectNumber& number) {
    return std::isfinite(number.standard_deviation) ? Json(number.standard_deviation) : Json();
  });
}

Json JsonUnits(const Effect& effect) {
  const EffectKind* kind = FindEffectKind(effect.name);
  Json units = Json::object();
  if (kind == nullptr && effect.parameters.size() > 0)
    units["coefficients"] = IsOfLegs(effect) ? "m" : "m, rad";
  if (kind == nullptr) return units;
  for (const ParameterKind& parameter : kind->parameters)
    units[std::string(parameter.name)] = std::string(parameter.unit);
  return units;
}

Json JsonEffect(const Effect& effect) {
  Json object = {{"name", effect.name},
                 {"index", effect.index},
                 {"parameters", JsonParameters(effect)},
                 {"standard_deviation", JsonDeviations(effect)},
                 {"units", JsonUnits(effect)}};
  AddDescription(effect, &object);
  return object;
}

void AddDescription(const Effect& effect, Json* object) {
  if (!effect.found.empty()) (*object)["found"] = effect.found;
  const bool is_unknown = FindEffectKind(effect.name) == nullptr;
  if (is_unknown && !effect.reference.empty()) (*object)["reference"] = effect.reference;
}

}  // namespace hexcal
