// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "estimator/observations.h"
#include "residuals/pose_error.h"

namespace hexcal {

// Position and orientation noise of the measured poses from what a fit leaves (variance
// components): the levels at which the restricted likelihood of the residuals is largest, so that
// the 12 fitted parameters do not make them too small. The residuals are linearised at mounts.
// Robot noise, where stated, counts as known. Reference: Searle, Casella, McCulloch, Variance
// Components (1992), ch. 6.
NoiseLevels EstimateNoise(const Observations& observations,
                          const BaseAndTool& mounts,
                          const NoiseLevels& start);

// As above for a fit that solves sum J' S e = 0 (equal weights, 1 m against 1 rad) and is not
// moved: the levels whose expected sums of squares, through that fit, are the ones seen (Helmert's
// estimator). S, one an observation, is what the fit made of an error e: PaperErrorDerivative for
// the paper's, empty for the identity.
NoiseLevels EstimateNoiseOfEqualWeights(const Observations& observations,
                                        const BaseAndTool& mounts,
                                        const std::vector<Matrix6d>& error_derivatives);

// Levels to begin with: root mean square of what mounts leaves, per coordinate; never below
// rounding.
NoiseLevels RoughNoise(const Observations& observations, const BaseAndTool& mounts);

}  // namespace hexcal
