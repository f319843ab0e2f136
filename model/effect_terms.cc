// SPDX-License-Identifier: BSD-3-Clause
#include "model/effect_terms.h"

#include <glog/logging.h>

#include <algorithm>

namespace hexcal {

const std::vector<double>& Reference(const EffectInput& input, const std::string& name) {
  const auto found = input.reference.find(name);
  CHECK(found != input.reference.end()) << "an effect without its " << name;
  CHECK(!found->second.empty()) << "an effect with an empty " << name;
  return found->second;
}

LegLengths HomeLengths(const EffectInput& input) {
  const auto found = input.reference.find("home_lengths");
  if (found == input.reference.end()) return input.visit.home_lengths;
  CHECK_EQ(found->second.size(), static_cast<std::size_t>(kNumLegs));
  return Eigen::Map<const LegLengths>(found->second.data());
}

double TimeOrRow(const EffectInput& input) {
  const bool is_row = Reference(input, "time_is_row")[0] != 0.0;
  return is_row ? input.visit.row : input.visit.time;
}

double Warming(const EffectInput& input) {
  return input.visit.temperature - Reference(input, "reference_temperature")[0];
}

bool Carries(const EffectInput& input, int leg) {
  const std::vector<int>& index = input.index;
  return index.empty() || std::find(index.begin(), index.end(), leg + 1) != index.end();
}

ParameterKind Twist(std::string_view unit, double scale, double rotation_scale) {
  ParameterKind twist = {"twist", unit, 6, scale};
  twist.rotation_scale = rotation_scale;
  return twist;
}

ParameterKind Searched(std::string_view name, std::string_view unit, double scale) {
  ParameterKind searched = {name, unit, 1, scale, true};
  searched.acts_alone = false;
  return searched;
}

}  // namespace hexcal
