// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "estimator/monte_carlo.h"

namespace hexcal {

// What repetition says of the covariance of first order. kUndecided: too few repetitions to tell.
enum class PropagationVerdict { kValidated, kDiffers, kUndecided };

// Of a check that was done.
PropagationVerdict VerdictOf(const PropagationCheck& check);

// Whether the limits differ by more than the tolerance and what so few repetitions leave open.
bool IsFoundToDiffer(const IntervalCheck& interval);

// About so many repetitions, two digits, would be enough for the limits to stand still.
double DrawsNeeded(const PropagationCheck& check);

}  // namespace hexcal
