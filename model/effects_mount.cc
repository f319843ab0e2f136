// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "model/effect_terms.h"

namespace hexcal {
namespace {

// Effects of where the base stands, where the tool sits, and when the platform is read.

// From 0 at the origin of the time to 1 a span later: straight, or with a time constant.
template <typename T>
T Progress(const EffectInput& input, const T& time_constant) {
  using std::exp;
  const double elapsed = TimeOrRow(input) - Reference(input, "time_origin")[0];
  const double span = Reference(input, "time_span")[0];
  if (time_constant == T(0)) return T(elapsed / span);
  const T reached = T(1) - exp(T(T(-elapsed) / time_constant));
  const T at_end = T(1) - exp(T(T(-span) / time_constant));
  return reached / at_end;
}

// parameters: twist, time_constant.
template <typename T>
void BaseDrift(const EffectInput& input, const T* parameters, Corrections<T>* corrections) {
  AddTwist(parameters, Progress(input, parameters[6]), corrections->base_twist);
}

template <typename T>
void ToolDrift(const EffectInput& input, const T* parameters, Corrections<T>* corrections) {
  AddTwist(parameters, Progress(input, parameters[6]), corrections->tool_twist);
}

// parameters: twist, time.
template <typename T>
void BaseStep(const EffectInput& input, const T* parameters, Corrections<T>* corrections) {
  if (T(TimeOrRow(input)) >= parameters[6]) AddTwist(parameters, 1.0, corrections->base_twist);
}

template <typename T>
void ToolStep(const EffectInput& input, const T* parameters, Corrections<T>* corrections) {
  if (T(TimeOrRow(input)) >= parameters[6]) AddTwist(parameters, 1.0, corrections->tool_twist);
}

// The base turns about the moment of the payload's weight at the platform's origin, frame B.
template <typename T>
void BaseFlexure(const EffectInput& input, const T* compliance, Corrections<T>* corrections) {
  const Visit& visit = input.visit;
  const Eigen::Vector3d weight = visit.payload * kStandardGravity * visit.gravity_in_base;
  const Eigen::Vector3d moment = visit.base_from_platform.translation.cross(weight);
  for (int k = 0; k < 3; ++k) corrections->base_twist[3 + k] += compliance[0] * moment[k];
}

// parameters: deflection, rotation. Gravity as the platform sees it, its numbers taken as a twist
// right of platform_from_tool: the tool gives way and tips about its own origin.
template <typename T>
void ToolSag(const EffectInput& input, const T* parameters, Corrections<T>* corrections) {
  const Visit& visit = input.visit;
  const Eigen::Vector3d down =
      visit.base_from_platform.rotation.conjugate() * visit.gravity_in_base;
  const Eigen::Vector3d axis = Eigen::Vector3d::UnitZ().cross(down);
  for (int k = 0; k < 3; ++k) {
    corrections->tool_twist[k] += parameters[0] * down[k];
    corrections->tool_twist[3 + k] += parameters[1] * axis[k];
  }
}

template <typename T>
void ToolThermal(const EffectInput& input, const T* twist, Corrections<T>* corrections) {
  AddTwist(twist, Warming(input), corrections->tool_twist);
}

// The tracker reads the tool by delay later than the robot its own pose.
template <typename T>
void Latency(const EffectInput& input, const T* delay, Corrections<T>* corrections) {
  for (int k = 0; k < 6; ++k) corrections->platform_twist[k] += delay[0] * input.visit.velocity[k];
}

const std::vector<ReferenceKind>& DriftReferences() {
  static const std::vector<ReferenceKind> references = {
      {"time_origin", "s or rows"}, {"time_span", "s or rows"}, {"time_is_row", "1"}};
  return references;
}

}  // namespace

std::vector<EffectKind> MountEffects() {
  const ParameterKind twist = Twist("m, rad", 1e-4, 2e-4);
  const ReferenceKind time_is_row = {"time_is_row", "1"};
  return {
      {"base_drift",
       "base",
       "time",
       "linear (or exponential)",
       "The base creeps on its stand, or the tracker on its own.",
       {twist, Searched("time_constant", "s", 0.0)},
       {"order"},
       BaseDrift<double>,
       BaseDrift<Dual>,
       DriftReferences()},
      {"tool_drift",
       "tool",
       "time",
       "linear (or exponential)",
       "The tool creeps in its clamp.",
       {twist, Searched("time_constant", "s", 0.0)},
       {"order"},
       ToolDrift<double>,
       ToolDrift<Dual>,
       DriftReferences(),
       -1.0},
      {"base_step",
       "base",
       "time",
       "step",
       "The base, or the markers on it, was knocked.",
       {twist, Searched("time", "s", 0.0)},
       {"order"},
       BaseStep<double>,
       BaseStep<Dual>,
       {time_is_row}},
      {"tool_step",
       "tool",
       "time",
       "step",
       "The tool, or the markers on it, slipped.",
       {twist, Searched("time", "s", 0.0)},
       {"order"},
       ToolStep<double>,
       ToolStep<Dual>,
       {time_is_row}},
      {"base_flexure",
       "base",
       "platform position × payload",
       "linear",
       "The frame under the base gives way to the moment of the payload.",
       {{"compliance", "rad/(N m)", 1, 1e-5}},
       {"payload", "gravity"},
       BaseFlexure<double>,
       BaseFlexure<Dual>},
      {"tool_sag",
       "tool",
       "gravity seen from the platform",
       "linear",
       "Platform and tool bend under their own weight.",
       {{"deflection", "m", 1, 5e-5}, {"rotation", "rad", 1, 1e-4}},
       {"gravity"},
       ToolSag<double>,
       ToolSag<Dual>},
      {"tool_thermal",
       "tool",
       "temperature",
       "linear",
       "The tool grows and bends with temperature.",
       {Twist("m/K, rad/K", 1e-5, 2e-5)},
       {"temperature"},
       ToolThermal<double>,
       ToolThermal<Dual>,
       {{"reference_temperature", "degC"}}},
      {"latency",
       "platform",
       "velocity",
       "linear",
       "Robot and tracker do not read at the same moment while the platform moves.",
       {{"delay", "s", 1, 1e-2}},
       {"velocity"},
       Latency<double>,
       Latency<Dual>},
  };
}

}  // namespace hexcal
