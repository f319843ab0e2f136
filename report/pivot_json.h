// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "estimator/pivot.h"

namespace hexcal {

// pivot.json, format hexcal/pivot/1 (docs/pivot.md); the same on one line.
std::string PivotJson(const Dataset& dataset, const PivotResult& result);
std::string PivotJsonLine(const Dataset& dataset, const PivotResult& result);

}  // namespace hexcal
