// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "report/audit.h"
#include "report/html/page.h"

namespace hexcal {

// What a point's error is made of, where it is worst.
Chart BudgetChart(const PointReport& report);

}  // namespace hexcal
