// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "report/audit.h"
#include "report/html/page.h"

namespace hexcal {

// Pictures of how sure a calibration is, each with the table of its numbers. mm.

// The 12 x 12 correlations.
Chart CorrelationChart(const Estimate& estimate);

// A point's error over the workspace.
Chart MapChart(const PointReport& report);

}  // namespace hexcal
