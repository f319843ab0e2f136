// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "estimator/estimate.h"
#include "estimator/observations.h"

namespace hexcal {

// Noise below so many roundings is none that was measured.
constexpr double kRoundingsOfNoise = 1e4;

// Whether noise that was estimated is no more than the rounding of the numbers: of positions and of
// orientations. Nothing can be said of the noise of a measurement then.
bool IsOnlyRounding(const Observations& observations, const NoiseSummary& noise);

}  // namespace hexcal
