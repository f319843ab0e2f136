// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "estimator/compare.h"
#include "report/run_record.h"

namespace hexcal {

// compare.json (docs/results.md), format hexcal/compare/1: no times. SI units. What the data cannot
// determine is null.
std::string CompareJson(const std::string& dataset,
                        const CompareOptions& options,
                        const Comparison& comparison);

// The same object on one line.
std::string CompareJsonLine(const std::string& dataset,
                            const CompareOptions& options,
                            const Comparison& comparison);

// How long each method took, for run.json.
std::vector<MethodTime> TimesOf(const Comparison& comparison);

}  // namespace hexcal
