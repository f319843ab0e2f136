// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "model/effect_terms.h"

namespace hexcal {
namespace {

// Effects of the joints' places on the two plates.

// offset: x, y, z of joint 1, then of joint 2...
template <typename T>
void AddOffsets(const T* offset, typename Corrections<T>::Matrix36& joints) {
  for (int i = 0; i < kNumLegs; ++i)
    for (int k = 0; k < 3; ++k) joints(k, i) += offset[3 * i + k];
}

template <typename T>
void AddScaled(const T& factor,
               const Matrix36d& directions,
               typename Corrections<T>::Matrix36& joints) {
  for (int i = 0; i < kNumLegs; ++i)
    for (int k = 0; k < 3; ++k) joints(k, i) += factor * directions(k, i);
}

template <typename T>
void BaseJointOffset(const EffectInput&, const T* offset, Corrections<T>* corrections) {
  AddOffsets(offset, corrections->base_joints);
}

template <typename T>
void PlatformJointOffset(const EffectInput&, const T* offset, Corrections<T>* corrections) {
  AddOffsets(offset, corrections->platform_joints);
}

template <typename T>
void BaseRadius(const EffectInput& input, const T* growth, Corrections<T>* corrections) {
  AddScaled(growth[0], input.visit.plates->base_radial, corrections->base_joints);
}

template <typename T>
void PlatformRadius(const EffectInput& input, const T* growth, Corrections<T>* corrections) {
  AddScaled(growth[0], input.visit.plates->platform_radial, corrections->platform_joints);
}

// Where the two axes of a universal joint miss each other by an offset, the leg is shorter by it
// times the sine of the angle between leg and first axis. offset: on the base, on the platform.
template <typename T>
void JointAxisOffset(const EffectInput& input, const T* offset, Corrections<T>* corrections) {
  const auto sine = [](double cosine) { return std::sqrt(std::max(0.0, 1.0 - cosine * cosine)); };
  for (int i = 0; i < kNumLegs; ++i) {
    if (!Carries(input, i)) continue;
    corrections->leg[i] -= offset[0] * sine(input.visit.base_axis_cosine[i]);
    corrections->leg[i] -= offset[1] * sine(input.visit.platform_axis_cosine[i]);
  }
}

template <typename T>
void PlateThermal(const EffectInput& input, const T* expansion, Corrections<T>* corrections) {
  const Plates& plates = *input.visit.plates;
  const T growth = expansion[0] * Warming(input);
  AddScaled(growth, plates.base_joints, corrections->base_joints);
  AddScaled(growth, plates.platform_joints, corrections->platform_joints);
}

}  // namespace

std::vector<EffectKind> JointEffects() {
  return {
      {"base_joint_offset",
       "base_joint",
       "constant",
       "constant",
       "The joints of the base are not where the drawing puts them.",
       {{"offset", "m", 18, 1e-4}},
       {"legs"},
       BaseJointOffset<double>,
       BaseJointOffset<Dual>},
      {"platform_joint_offset",
       "platform_joint",
       "constant",
       "constant",
       "The joints of the platform are not where the drawing puts them.",
       {{"offset", "m", 18, 1e-4}},
       {"legs"},
       PlatformJointOffset<double>,
       PlatformJointOffset<Dual>},
      {"base_radius",
       "base_joint",
       "constant",
       "constant",
       "The circle of the base's joints is larger or smaller than drawn.",
       {{"growth", "m", 1, 1e-4}},
       {"legs"},
       BaseRadius<double>,
       BaseRadius<Dual>},
      {"platform_radius",
       "platform_joint",
       "constant",
       "constant",
       "The circle of the platform's joints is larger or smaller than drawn.",
       {{"growth", "m", 1, 1e-4}},
       {"legs"},
       PlatformRadius<double>,
       PlatformRadius<Dual>},
      {"joint_axis_offset",
       "base_joint or platform_joint",
       "joint angle",
       "even",
       "The two axes of the universal joints do not meet.",
       {{"offset", "m", 2, 1e-4}},
       {"legs"},
       JointAxisOffset<double>,
       JointAxisOffset<Dual>},
      {"plate_thermal",
       "base_joint and platform_joint",
       "temperature",
       "linear",
       "The two plates grow with temperature.",
       {{"expansion", "1/K", 1, 1.2e-5}},
       {"legs", "temperature"},
       PlateThermal<double>,
       PlateThermal<Dual>,
       {{"reference_temperature", "degC"}}},
  };
}

}  // namespace hexcal
