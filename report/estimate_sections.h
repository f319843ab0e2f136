// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "estimator/estimate.h"
#include "report/html/page.h"
#include "report/run_record.h"

namespace hexcal {

// Sections that several reports have in common.

// Both mounts with their uncertainty, correlations and what the poses do not determine.
void AddMounts(const Estimate& estimate, HtmlPage* page);

// Warnings, settings, inputs and versions. files: what the same input gives again, in words.
void AddReproduction(const RunRecord& record,
                     const std::vector<std::string>& warnings,
                     std::string_view files,
                     HtmlPage* page);

}  // namespace hexcal
