// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "discovery/discovery.h"
#include "report/html/page.h"

namespace hexcal {

// The pictures of a discovery, each with the table of its numbers. mm and mrad.

// Position, then orientation: the gap before and after on the data and on held-out poses, and the
// noise floor.
std::vector<Chart> GapCharts(const Discovery& discovery);

// The gap on the data after each step.
Chart StepChart(const Discovery& discovery);

// The best candidates of step number `step`, from 1.
Chart RankingChart(const Step& step, std::size_t number);

// Sizes with their 95 % intervals, of parameters that are several numbers.
std::vector<Chart> SizeCharts(const DiscoveredEffect& found);

}  // namespace hexcal
