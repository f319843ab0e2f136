// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "report/audit.h"

namespace hexcal {

// What the error of a point at a place is made of. at: by the sources of the audit and of the
// point.
std::vector<BudgetRow> BudgetOf(const Audit& audit,
                                const NamedPoint& point,
                                const TargetCovariance& at);

}  // namespace hexcal
