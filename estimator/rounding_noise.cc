// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/rounding_noise.h"

namespace hexcal {

bool IsOnlyRounding(const Observations& observations, const NoiseSummary& noise) {
  if (!noise.estimated) return false;
  const NoiseLevels rounding = Rounding(observations.items);
  return noise.position <= kRoundingsOfNoise * rounding.position &&
         noise.orientation <= kRoundingsOfNoise * rounding.orientation;
}

}  // namespace hexcal
