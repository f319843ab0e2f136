// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "discovery/discovery.h"
#include "report/html/page.h"

namespace hexcal {

// Pictures of what is left over at every pose, before and after, each with the table of its
// numbers. mm and mrad.

// Position, then orientation: each axis against the order of visit, before and after.
std::vector<Chart> ResidualCharts(const std::vector<PoseGap>& poses);

// Empty where no legs are known: leg-space residuals against the leg's length, and leg by pose.
std::vector<Chart> LegCharts(const std::vector<PoseGap>& poses);

}  // namespace hexcal
