// SPDX-License-Identifier: BSD-3-Clause
#include <glog/logging.h>

#include "model/effect_terms.h"

namespace hexcal {
namespace {

// Effects of single markers in their bodies' frames.

// offset: x, y, z for each marker in the index.
template <typename T>
void AddToMarkers(const EffectInput& input, const T* offset, Corrections<T>* corrections) {
  const std::vector<double>& counts = Reference(input, "markers");
  CHECK_EQ(counts.size(), 2u);
  for (std::size_t body = 0; body < 2; ++body) {
    auto& markers = corrections->markers[body];
    if (markers.cols() == 0) markers.setConstant(3, static_cast<int>(counts[body]), T(0));
  }
  for (std::size_t n = 0; n < input.index.size(); ++n) {
    const int in_base = static_cast<int>(counts[0]), marker = input.index[n] - 1;
    CHECK(marker >= 0 && marker < in_base + static_cast<int>(counts[1])) << "no such marker";
    const int body = marker < in_base ? 0 : 1, column = marker - body * in_base;
    for (int k = 0; k < 3; ++k) corrections->markers[body](k, column) += offset[3 * n + k];
  }
}

template <typename T>
void MarkerOffset(const EffectInput& input, const T* offset, Corrections<T>* corrections) {
  AddToMarkers(input, offset, corrections);
}

// parameters: time, offset.
template <typename T>
void MarkerShift(const EffectInput& input, const T* parameters, Corrections<T>* corrections) {
  if (T(TimeOrRow(input)) >= parameters[0]) AddToMarkers(input, parameters + 1, corrections);
}

ParameterKind OffsetPerMarker() {
  ParameterKind offset = {"offset", "m", 3, 1e-4};
  offset.is_per_marker = true;
  return offset;
}

}  // namespace

std::vector<EffectKind> MarkerEffects() {
  const ReferenceKind markers = {"markers", "1", 2};
  return {
      {"marker_offset",
       "marker",
       "constant",
       "constant",
       "A marker is not where the body's file puts it.",
       {OffsetPerMarker()},
       {"markers"},
       MarkerOffset<double>,
       MarkerOffset<Dual>,
       {markers}},
      {"marker_shift",
       "marker",
       "time",
       "step",
       "A marker was knocked or soiled during the measurement.",
       {Searched("time", "s", 0.0), OffsetPerMarker()},
       {"markers", "order"},
       MarkerShift<double>,
       MarkerShift<Dual>,
       {markers, {"time_is_row", "1"}}},
  };
}

}  // namespace hexcal
