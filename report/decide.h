// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "report/audit.h"

namespace hexcal {

// Where a point's error is longest, and how long it is there with this probability.
struct Worst {
  Place place;
  double length = 0.0;              // m
  double degrees_of_freedom = 0.0;  // with which it is known
};
// places: one or more.
Worst WorstPlace(const TargetError& error,
                 const Eigen::Vector3d& p_in_tool,
                 const std::vector<Place>& places,
                 double probability);

// Guarded acceptance (JCGM 106:2012, 8.3): the length that the error does not exceed where it is
// worst, and a guard band w of twice its standard uncertainty. PASS: length + w within the limit,
// and no doubt in the audit; FAIL: length - w above it; else INCONCLUSIVE, as for a calibration
// that cannot be trusted. audit: all but decisions. The standard uncertainty of the length is that
// of the standard deviations it is made of (1 / sqrt(2 nu), JCGM 100, E.4.3) and what repetition
// has it differ by.
Decision Decide(const Audit& audit,
                const Requirement& requirement,
                const std::vector<Place>& places);

// FAIL if one fails, else INCONCLUSIVE if one is, else PASS; none without any.
Compliance Together(const std::vector<Decision>& decisions);

}  // namespace hexcal
