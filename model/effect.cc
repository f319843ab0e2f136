// SPDX-License-Identifier: BSD-3-Clause
#include "model/effect.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>

#include "model/described_effect.h"

namespace hexcal {
namespace {

struct Need {
  std::string_view name;
  bool Drivers::*driver;
  std::string_view in_words;
};

constexpr Need kNeeds[] = {
    {"legs", &Drivers::legs, "a hexapod with base_joints and platform_joints"},
    {"time", &Drivers::time, "a time column"},
    {"temperature", &Drivers::temperature, "a temperature column"},
    {"payload", &Drivers::payload, "a payload column"},
    {"gravity", &Drivers::gravity, "the direction of gravity"},
    {"velocity", &Drivers::velocity, "velocity columns (vx vy vz wx wy wz)"},
    {"order", &Drivers::order, "more than one pose"},
    {"markers", &Drivers::markers, "readings of single markers"},
};

const EffectKind& KindOf(const Effect& effect) {
  const EffectKind* kind = FindEffectKind(effect.name);
  CHECK(kind != nullptr) << "no effect called " << effect.name;
  CHECK_EQ(effect.parameters.size(), kind->SizeFor(effect.index)) << effect.name;
  return *kind;
}

struct Times {
  bool is_row = false;
  double first = 0.0, last = 0.0;
};

Times TimesOf(const std::vector<Visit>& visits) {
  Times times;
  CHECK(!visits.empty());
  times.is_row = std::isnan(visits.front().time);
  const auto time = [&](const Visit& visit) { return times.is_row ? visit.row : visit.time; };
  times.first = times.last = time(visits.front());
  for (const Visit& visit : visits) {
    times.first = std::min(times.first, time(visit));
    times.last = std::max(times.last, time(visit));
  }
  return times;
}

double ReferenceTemperature(const std::vector<Visit>& visits, const Dataset& dataset) {
  if (dataset.reference_temperature) return *dataset.reference_temperature;
  double sum = 0.0;
  for (const Visit& visit : visits) sum += visit.temperature;
  return sum / visits.size();
}

std::vector<double> Numbers(const Vector6d& v) { return {v.data(), v.data() + v.size()}; }

std::vector<double> MarkerCounts(const Dataset& dataset) {
  if (!dataset.measurement) return {0.0, 0.0};
  const auto& bodies = dataset.measurement->bodies;
  return {static_cast<double>(bodies[0].markers.size()),
          static_cast<double>(bodies[1].markers.size())};
}

// The only place that knows what a reference's name means.
std::vector<double> ReferenceCalled(std::string_view name,
                                    const std::vector<Visit>& visits,
                                    const Dataset& dataset) {
  CHECK(!visits.empty());
  const Times times = TimesOf(visits);
  if (name == "home_lengths") return Numbers(visits.front().home_lengths);
  if (name == "home_roll") return Numbers(visits.front().home_roll);
  if (name == "reference_temperature") return {ReferenceTemperature(visits, dataset)};
  if (name == "time_is_row") return {times.is_row ? 1.0 : 0.0};
  if (name == "time_origin") return {times.first};
  if (name == "time_span") return {times.last > times.first ? times.last - times.first : 1.0};
  CHECK(name == "markers") << "no reference called " << name;
  return MarkerCounts(dataset);
}

template <typename Derived>
auto SlopesOf(const Eigen::MatrixBase<Derived>& duals) {
  return duals.unaryExpr([](const Dual& dual) { return dual.derivatives()[0]; }).eval();
}

Corrections<double> SlopesOf(const Corrections<Dual>& duals) {
  Corrections<double> slopes;
  slopes.leg = SlopesOf(duals.leg);
  slopes.base_joints = SlopesOf(duals.base_joints);
  slopes.platform_joints = SlopesOf(duals.platform_joints);
  slopes.base_twist = SlopesOf(duals.base_twist);
  slopes.platform_twist = SlopesOf(duals.platform_twist);
  slopes.tool_twist = SlopesOf(duals.tool_twist);
  slopes.tracker_scale = duals.tracker_scale.derivatives()[0];
  slopes.tracker_depth_scale = duals.tracker_depth_scale.derivatives()[0];
  slopes.tracker_distortion = duals.tracker_distortion.derivatives()[0];
  slopes.tracker_twist = SlopesOf(duals.tracker_twist);
  for (int body = 0; body < 2; ++body) slopes.markers[body] = SlopesOf(duals.markers[body]);
  return slopes;
}

}  // namespace

int EffectKind::size() const {
  int sum = 0;
  for (const ParameterKind& parameter : parameters) sum += parameter.size;
  return sum;
}

int EffectKind::SizeFor(const std::vector<int>& index) const {
  int sum = 0;
  for (const ParameterKind& parameter : parameters)
    sum += parameter.size * (parameter.is_per_marker ? static_cast<int>(index.size()) : 1);
  return sum;
}

int EffectKind::OffsetOf(std::string_view parameter) const {
  int offset = 0;
  for (const ParameterKind& candidate : parameters) {
    if (candidate.name == parameter) return offset;
    offset += candidate.size;
  }
  LOG(FATAL) << name << " has no parameter called " << parameter;
}

const ParameterKind& EffectKind::ParameterOf(int number) const {
  CHECK_GE(number, 0);
  int end = 0;
  for (const ParameterKind& parameter : parameters) {
    end += parameter.size;
    if (number < end || parameter.is_per_marker) return parameter;
  }
  LOG(FATAL) << name << " has no parameter number " << number;
}

double EffectKind::ScaleOf(int number) const {
  const ParameterKind& parameter = ParameterOf(number);
  const bool is_rotation = parameter.rotation_scale > 0.0 && number - OffsetOf(parameter.name) >= 3;
  return is_rotation ? parameter.rotation_scale : parameter.scale;
}

std::string_view EffectKind::UnitOf(int number) const {
  const ParameterKind& parameter = ParameterOf(number);
  const std::size_t comma = parameter.unit.find(", ");
  if (comma == std::string_view::npos) return parameter.unit;
  const bool is_rotation = number - OffsetOf(parameter.name) >= 3;
  return is_rotation ? parameter.unit.substr(comma + 2) : parameter.unit.substr(0, comma);
}

std::string MissingFor(const EffectKind& kind, const Drivers& drivers) {
  std::string missing;
  for (const Need& need : kNeeds) {
    if (std::find(kind.needs.begin(), kind.needs.end(), need.name) == kind.needs.end()) continue;
    if (drivers.*need.driver) continue;
    if (!missing.empty()) missing += ", ";
    missing += need.in_words;
  }
  return missing;
}

EffectReference ReferenceFor(const EffectKind& kind,
                             const std::vector<Visit>& visits,
                             const Dataset& dataset) {
  EffectReference reference;
  for (const ReferenceKind& asked : kind.references)
    reference[std::string(asked.name)] = ReferenceCalled(asked.name, visits, dataset);
  return reference;
}

Corrections<double> CorrectionsOf(const std::vector<Effect>& effects, const Visit& visit) {
  Corrections<double> corrections;
  for (const Effect& effect : effects) {
    if (effect.name == kUnknownEffect) {
      AddDescribed(effect, effect.parameters, visit, &corrections);
      continue;
    }
    const EffectKind& kind = KindOf(effect);
    const EffectInput input = {visit, effect.index, effect.reference};
    if (!kind.IsFault()) kind.apply(input, effect.parameters.data(), &corrections);
  }
  return corrections;
}

Corrections<double> CorrectionsBy(const Effect& effect, int parameter, const Visit& visit) {
  if (effect.name == kUnknownEffect) {
    Corrections<double> slopes;
    AddDescribed(
        effect, Eigen::VectorXd::Unit(effect.parameters.size(), parameter), visit, &slopes);
    return slopes;
  }
  const EffectKind& kind = KindOf(effect);
  CHECK(!kind.IsFault()) << effect.name << " has no parameter";
  CHECK(parameter >= 0 && parameter < effect.parameters.size());
  std::vector<Dual> parameters;
  for (const double value : effect.parameters) parameters.emplace_back(value);
  parameters[parameter].derivatives()[0] = 1.0;
  Corrections<Dual> corrections;
  kind.apply_dual({visit, effect.index, effect.reference}, parameters.data(), &corrections);
  return SlopesOf(corrections);
}

}  // namespace hexcal
