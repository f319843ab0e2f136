// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "estimator/grown_problem.h"

namespace hexcal {

// All numbers of an effect that carry it and that a fit can move (no time of a step, which no
// derivative sees), with priors around zero of `widths` times the plausible scale, or times the RMS
// of the numbers that the effect already has where that is more; those that are searched for, and
// those without a scale, around where they stand without a prior.
GrownEffect FreeEffect(const Effect& effect, double widths);

}  // namespace hexcal
