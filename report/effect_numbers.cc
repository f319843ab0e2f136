// SPDX-License-Identifier: BSD-3-Clause
#include "report/effect_numbers.h"

#include <fmt/format.h>
#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace hexcal {
namespace {

constexpr int kLegs = 6;
constexpr const char* kTwist[6] = {"dx", "dy", "dz", "rx", "ry", "rz"};
constexpr const char* kAxes[3] = {"x", "y", "z"};

// Six numbers are the legs' for what acts in legs and joints, else a twist.
bool IsOfLegs(const EffectKind& kind, const ParameterKind& parameter) {
  return parameter.size % kLegs == 0 && parameter.unit.find(',') == std::string_view::npos &&
         (kind.site.find("leg") != std::string_view::npos ||
          kind.site.find("joint") != std::string_view::npos);
}

std::string MarkerLabel(std::size_t i,
                        const Effect& effect,
                        const std::vector<std::string>& labels) {
  return i < labels.size() ? labels[i] : fmt::format("marker {}", effect.index[i]);
}

// What the n-th number of a parameter belongs to.
std::string PartOf(const EffectKind& kind,
                   const ParameterKind& parameter,
                   int n,
                   const Effect& effect,
                   const std::vector<std::string>& labels) {
  if (parameter.is_per_marker)
    return fmt::format(
        "{} {}", MarkerLabel(n / parameter.size, effect, labels), kAxes[n % parameter.size % 3]);
  if (parameter.size == 1) return "";
  if (!IsOfLegs(kind, parameter)) return n < 6 ? kTwist[n] : fmt::format("{}", n + 1);
  const int per_leg = parameter.size / kLegs;
  if (per_leg == 1) return fmt::format("leg {}", n + 1);
  return fmt::format("joint {} {}", n / per_leg + 1, kAxes[n % per_leg % 3]);
}

bool IsCarried(const EffectKind& kind,
               const ParameterKind& parameter,
               int n,
               const Effect& effect) {
  if (effect.index.empty() || parameter.is_per_marker || !IsOfLegs(kind, parameter)) return true;
  const int leg = n / (parameter.size / kLegs) + 1;
  return std::find(effect.index.begin(), effect.index.end(), leg) != effect.index.end();
}

std::string UnitOf(const EffectKind& kind, const ParameterKind& parameter, int number) {
  if (parameter.name.substr(0, 5) == "phase") return "phase";
  return std::string(kind.UnitOf(number));
}

int ColumnsOf(const ParameterKind& parameter) {
  if (parameter.is_per_marker) return parameter.size;
  if (parameter.size == 1) return 0;
  return parameter.size > kLegs ? parameter.size / kLegs : parameter.size;
}

// Six numbers, or six a term of a map of the pose: legs', or a twist's.
std::vector<EffectParameter> CoefficientsOf(const Effect& effect) {
  if (effect.parameters.size() == 0) return {};
  const bool is_of_legs = IsOfLegs(effect);
  const bool has_deviations = effect.standard_deviation.size() == effect.parameters.size();
  EffectParameter coefficients = {"coefficients", {}, kLegs};
  for (int n = 0; n < effect.parameters.size(); ++n)
    coefficients.numbers.push_back(
        {is_of_legs ? fmt::format("leg {}", n + 1) : kTwist[n % 6],
         effect.parameters[n],
         has_deviations ? effect.standard_deviation[n] : std::numeric_limits<double>::quiet_NaN(),
         is_of_legs || n % 6 < 3 ? "m" : "rad",
         true});
  return {coefficients};
}

}  // namespace

bool IsOfLegs(const Effect& unknown) {
  const auto site = unknown.found.find("site");
  return site != unknown.found.end() && site->second == "leg";
}

bool IsShown(const EffectNumber& number) {
  return number.is_carried && (number.value != 0.0 || std::isfinite(number.standard_deviation));
}

std::string FreeNumberName(const EffectKind& kind, int number) {
  const ParameterKind& parameter = kind.ParameterOf(number);
  if (parameter.size == 1) return std::string(parameter.name);
  return fmt::format("{} {}", parameter.name, number - kind.OffsetOf(parameter.name) + 1);
}

std::vector<EffectParameter> ParametersOf(const Effect& effect,
                                          const std::vector<std::string>& labels) {
  const EffectKind* kind = FindEffectKind(effect.name);
  if (kind == nullptr) return CoefficientsOf(effect);
  if (kind->IsFault()) return {};
  CHECK_EQ(effect.parameters.size(), kind->SizeFor(effect.index)) << effect.name;
  const bool has_deviations = effect.standard_deviation.size() == effect.parameters.size();
  std::vector<EffectParameter> parameters;
  int at = 0;
  for (const ParameterKind& parameter : kind->parameters) {
    const int count =
        parameter.size * (parameter.is_per_marker ? static_cast<int>(effect.index.size()) : 1);
    EffectParameter found = {std::string(parameter.name), {}, ColumnsOf(parameter)};
    for (int n = 0; n < count; ++n, ++at)
      found.numbers.push_back({PartOf(*kind, parameter, n, effect, labels),
                               effect.parameters[at],
                               has_deviations ? effect.standard_deviation[at]
                                              : std::numeric_limits<double>::quiet_NaN(),
                               UnitOf(*kind, parameter, at),
                               IsCarried(*kind, parameter, n, effect)});
    parameters.push_back(std::move(found));
  }
  return parameters;
}

}  // namespace hexcal
