// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "discovery/plan.h"

namespace hexcal {

// The plan as JSON (docs/plan.md), SI units.
std::string PlanJson(const std::string& dataset, const PlanOptions& options, const Plan& plan);
// All on one line.
std::string PlanJsonLine(const std::string& dataset, const PlanOptions& options, const Plan& plan);

}  // namespace hexcal
