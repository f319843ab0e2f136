// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "report/audit.h"

namespace hexcal {

// What the error of a point at a place of the workspace is made of.
Budget BudgetOf(const Audit& audit, const NamedPoint& point, const Pose3d& base_from_platform);

}  // namespace hexcal
