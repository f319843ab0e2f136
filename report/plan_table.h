// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "discovery/plan.h"

namespace hexcal {

// A plan for the screen: what it is worth, pair by pair and parameter by parameter.
std::string PlanTable(const std::string& dataset, const Plan& plan);

// As comment lines of a CSV: the mark, and what each pose is for.
inline constexpr const char* kPlanMark = "# Written by hexcal plan";
std::string PlanComments(const std::string& dataset, const Plan& plan);

}  // namespace hexcal
