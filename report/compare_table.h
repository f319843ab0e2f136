// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "estimator/compare.h"

namespace hexcal {

// The comparison for the terminal: a line a method, then what certificate and Monte Carlo say, then
// where the iterations arrive. mm, mrad, degrees; UTF-8.
std::string CompareTable(const std::string& dataset,
                         const CompareOptions& options,
                         const Comparison& comparison);

}  // namespace hexcal
