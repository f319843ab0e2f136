// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "report/html/page.h"
#include "report/pose_residuals.h"

namespace hexcal {

// Residuals in leg space, mm, against the legs' lengths, and leg by pose: what one leg does shows
// there. Empty where no legs are known.
std::vector<Chart> LegCharts(const PoseResiduals& residuals);

}  // namespace hexcal
