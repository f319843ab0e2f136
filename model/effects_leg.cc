// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "model/effect_terms.h"

namespace hexcal {
namespace {

// Effects of single legs: what to add to the length that the controller reports, m.

template <typename T>
void LegOffset(const EffectInput&, const T* offset, Corrections<T>* corrections) {
  for (int i = 0; i < kNumLegs; ++i) corrections->leg[i] += offset[i];
}

template <typename T>
void LegGain(const EffectInput& input, const T* gain, Corrections<T>* corrections) {
  const LegLengths travel = input.visit.lengths - HomeLengths(input);
  for (int i = 0; i < kNumLegs; ++i) corrections->leg[i] += gain[i] * travel[i];
}

template <typename T>
void LegNonlinearity(const EffectInput& input, const T* curvature, Corrections<T>* corrections) {
  const LegLengths travel = input.visit.lengths - HomeLengths(input);
  for (int i = 0; i < kNumLegs; ++i) corrections->leg[i] += curvature[i] * travel[i] * travel[i];
}

// The length itself, not the travel: a screw keeps its phase wherever home is.
template <typename T>
void LegPeriodic(const EffectInput& input, const T* parameters, Corrections<T>* corrections) {
  using std::sin;
  const T *amplitude = parameters, *phase = parameters + 6, *amplitude_2 = parameters + 13,
          *phase_2 = parameters + 19;
  const T period = parameters[12];
  if (!(period > T(0))) return;
  for (int i = 0; i < kNumLegs; ++i) {
    const T turn = T(2.0 * M_PI * input.visit.lengths[i]) / period;
    const T first = sin(T(turn + phase[i])), second = sin(T(T(2) * turn + phase_2[i]));
    corrections->leg[i] += amplitude[i] * first;
    corrections->leg[i] += amplitude_2[i] * second;
  }
}

template <typename T>
void LegScrewRotation(const EffectInput& input, const T* lead, Corrections<T>* corrections) {
  const Visit& visit = input.visit;
  const auto home = input.reference.find("home_roll");
  for (int i = 0; i < kNumLegs; ++i) {
    double roll = visit.roll[i];
    if (home != input.reference.end())
      roll = std::remainder(roll + visit.home_roll[i] - home->second[i], 2.0 * M_PI);
    if (Carries(input, i)) corrections->leg[i] += lead[0] * roll;
  }
}

template <typename T>
void LegBacklash(const EffectInput& input, const T* gap, Corrections<T>* corrections) {
  for (int i = 0; i < kNumLegs; ++i)
    corrections->leg[i] += gap[i] * (0.5 * input.visit.direction[i]);
}

template <typename T>
void LegThermal(const EffectInput& input, const T* expansion, Corrections<T>* corrections) {
  const double warming = Warming(input);
  for (int i = 0; i < kNumLegs; ++i)
    if (Carries(input, i)) corrections->leg[i] += expansion[0] * (warming * input.visit.lengths[i]);
}

template <typename T>
void Settling(const EffectInput& input, const T* fraction, Corrections<T>* corrections) {
  for (int i = 0; i < kNumLegs; ++i)
    if (Carries(input, i)) corrections->leg[i] -= fraction[0] * input.visit.last_move[i];
}

ParameterKind Phase(std::string_view name) {
  ParameterKind phase = {name, "rad", 6, 1.8};  // any: as wide as a whole turn
  phase.acts_alone = false;
  return phase;
}

}  // namespace

std::vector<EffectKind> LegEffects() {
  const ReferenceKind home = {"home_lengths", "m", kNumLegs};
  return {
      {"leg_offset",
       "leg",
       "constant",
       "constant",
       "Each leg's zero, found by homing it, is off by a constant.",
       {{"offset", "m", 6, 1e-4}},
       {"legs"},
       LegOffset<double>,
       LegOffset<Dual>},
      {"leg_gain",
       "leg",
       "leg_length",
       "linear about l_home",
       "The lead of the screw or the scale of the encoder is not what the controller takes it for.",
       {{"gain", "1", 6, 3e-4}},
       {"legs"},
       LegGain<double>,
       LegGain<Dual>,
       {home}},
      {"leg_nonlinearity",
       "leg",
       "leg_length",
       "quadratic about l_home",
       "The lead changes along the screw.",
       {{"curvature", "1/m", 6, 1e-2}},
       {"legs"},
       LegNonlinearity<double>,
       LegNonlinearity<Dual>,
       {home}},
      {"leg_periodic",
       "leg",
       "leg_length",
       "periodic",
       "The screw wobbles once a turn, or the encoder on it sits off its centre.",
       {{"amplitude", "m", 6, 1e-5},
        Phase("phase"),
        Searched("period", "m", 0.0),
        {"amplitude_2", "m", 6, 5e-6},
        Phase("phase_2")},
       {"legs"},
       LegPeriodic<double>,
       LegPeriodic<Dual>},
      {"leg_screw_rotation",
       "leg",
       "relative roll of the leg's joints",
       "linear",
       "The universal joints turn the nut against the screw, which the motor's encoder does not "
       "see.",
       {{"lead", "m/rad", 1, 1e-3}},
       {"legs"},
       LegScrewRotation<double>,
       LegScrewRotation<Dual>,
       {{"home_roll", "rad", kNumLegs}}},
      {"leg_backlash",
       "leg",
       "leg_direction",
       "sign",
       "The nut has play, taken up on the side from which the leg arrives.",
       {{"gap", "m", 6, 1e-5}},
       {"legs", "order"},
       LegBacklash<double>,
       LegBacklash<Dual>},
      {"leg_thermal",
       "leg",
       "temperature",
       "linear × l_i",
       "The legs grow with temperature.",
       {{"expansion", "1/K", 1, 1.2e-5}},
       {"legs", "temperature"},
       LegThermal<double>,
       LegThermal<Dual>,
       {{"reference_temperature", "degC"}}},
      {"settling",
       "leg",
       "last move",
       "linear",
       "The pose is read before the legs have come to rest: a fraction of their last move is still "
       "to go.",
       {{"fraction", "1", 1, 1e-3}},
       {"legs", "order"},
       Settling<double>,
       Settling<Dual>},
  };
}

}  // namespace hexcal
