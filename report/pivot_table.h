// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "estimator/pivot.h"

namespace hexcal {

// A pivoting for the screen, mm and degrees. Ends with a newline.
std::string PivotTable(const std::string& dataset, const PivotResult& result);

}  // namespace hexcal
