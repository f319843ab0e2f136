// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "discovery/form_library.h"
#include "discovery/refit.h"

namespace hexcal {

// A tracker that stood still sees the base through its own effects and through the base markers',
// too, so the frame that it took for the world is off by what they are on average. Puts that right
// in mounts, covariance, columns, and the seen and predicted poses of a refit; its residuals stay.
// library: the effects' free parameters as forms, in the order of the covariance. Nothing changes
// where the base was seen in every pose, or has no known shape.
void CorrectCommonWorld(const GapData& data, const FormLibrary& library, Refit* refit);

}  // namespace hexcal
