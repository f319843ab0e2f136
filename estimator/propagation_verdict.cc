// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/propagation_verdict.h"

#include <algorithm>
#include <cmath>

namespace hexcal {

bool IsFoundToDiffer(const IntervalCheck& interval) {
  const double surely = interval.tolerance + interval.accuracy;
  return !(interval.low_difference <= surely && interval.high_difference <= surely);
}

PropagationVerdict VerdictOf(const PropagationCheck& check) {
  if (check.stable)
    return check.validated ? PropagationVerdict::kValidated : PropagationVerdict::kDiffers;
  return std::any_of(check.intervals.begin(), check.intervals.end(), IsFoundToDiffer)
             ? PropagationVerdict::kDiffers
             : PropagationVerdict::kUndecided;
}

double DrawsNeeded(const PropagationCheck& check) {
  double most = 1.0;
  for (const IntervalCheck& interval : check.intervals)
    most = std::max(most, interval.accuracy / (kSettledShare * interval.tolerance));
  const double draws = check.draws * most * most;
  const double unit = std::pow(10.0, std::floor(std::log10(draws)) - 1.0);
  return unit * std::ceil(draws / unit);
}

}  // namespace hexcal
