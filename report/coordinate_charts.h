// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "report/html/page.h"
#include "report/pose_residuals.h"

namespace hexcal {

// What is left over against each of the six numbers of T_A^B, Eq. (2): position, then orientation,
// each with a table of correlations. Empty where the poses' numbers are not known.
std::vector<Chart> CoordinateCharts(const PoseResiduals& residuals);

// Correlation of two lists of one length; NaN where one does not vary.
double CorrelationOf(const std::vector<double>& a, const std::vector<double>& b);

}  // namespace hexcal
