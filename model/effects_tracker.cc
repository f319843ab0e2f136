// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "model/effect_terms.h"

namespace hexcal {
namespace {

// Effects of the tracker; Corrections says what its numbers do to a point.

template <typename T>
void TrackerScale(const EffectInput&, const T* scale, Corrections<T>* corrections) {
  corrections->tracker_scale += scale[0];
}

template <typename T>
void TrackerDepthScale(const EffectInput&, const T* scale, Corrections<T>* corrections) {
  corrections->tracker_depth_scale += scale[0];
}

template <typename T>
void TrackerDistortion(const EffectInput&, const T* coefficient, Corrections<T>* corrections) {
  corrections->tracker_distortion += coefficient[0];
}

// parameters: twist, scale, time_constant. All at the origin of the time, fading from there.
template <typename T>
void TrackerWarmup(const EffectInput& input, const T* parameters, Corrections<T>* corrections) {
  using std::exp;
  const T time_constant = parameters[7];
  if (!(time_constant > T(0))) return;
  const double elapsed = input.visit.time - Reference(input, "time_origin")[0];
  const T left = exp(T(T(-elapsed) / time_constant));
  AddTwist(parameters, left, corrections->tracker_twist);
  corrections->tracker_scale += parameters[6] * left;
}

}  // namespace

std::vector<EffectKind> TrackerEffects() {
  return {
      {"tracker_scale",
       "tracker",
       "position",
       "linear",
       "The distance between the tracker's cameras, or their focal length, is off.",
       {{"scale", "1", 1, 2e-4}},
       {},
       TrackerScale<double>,
       TrackerScale<Dual>},
      {"tracker_depth_scale",
       "tracker",
       "depth",
       "linear",
       "Two cameras side by side see depth less well than the rest.",
       {{"scale", "1", 1, 2e-4}},
       {"markers"},
       TrackerDepthScale<double>,
       TrackerDepthScale<Dual>},
      {"tracker_distortion",
       "tracker",
       "off-axis distance",
       "cubic",
       "The lenses distort more than their calibration says.",
       {{"coefficient", "1/m^2", 1, 5e-3}},
       {"markers"},
       TrackerDistortion<double>,
       TrackerDistortion<Dual>},
      {"tracker_warmup",
       "tracker",
       "time",
       "exponential",
       "The tracker was not warm when the measurement began.",
       {Twist("m, rad", 1e-4, 2e-4),
        {"scale", "1", 1, 1e-4},
        Searched("time_constant", "s", 1800.0)},
       {"time"},
       TrackerWarmup<double>,
       TrackerWarmup<Dual>,
       {{"time_origin", "s"}}},
  };
}

}  // namespace hexcal
