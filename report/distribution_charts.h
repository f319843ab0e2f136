// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "report/html/page.h"
#include "report/pose_residuals.h"

namespace hexcal {

// Whether what is left over looks like noise, each residual in its own standard deviations: how
// often each size occurs, sizes against those of a normal sample (Q-Q), and how alike neighbours
// in the order of visit are. Empty where nothing is known of the noise.
std::vector<Chart> DistributionCharts(const PoseResiduals& residuals);

}  // namespace hexcal
