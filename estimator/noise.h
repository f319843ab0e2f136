// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "estimator/observations.h"
#include "residuals/pose_error.h"

namespace hexcal {

// Position and orientation noise of the measured poses from what a fit leaves (variance
// components): the levels at which the restricted likelihood of the residuals is largest, so that
// the 12 fitted parameters do not make them too small. The residuals are linearised at mounts, and
// what a better fit would take from them is taken, so that the mounts need not be the best ones.
// Robot noise, where stated, counts as known. Never below rounding; a level of which the data say
// nothing stays as it was. Reference: Searle, Casella, McCulloch, Variance Components (1992), ch.
// 6.
NoiseLevels EstimateNoise(const Observations& observations,
                          const BaseAndTool& mounts,
                          const NoiseLevels& start);

}  // namespace hexcal
