// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/propagation_verdict.h"

#include <gtest/gtest.h>

#include <cmath>

namespace hexcal {
namespace {

// Sigma 1.2: half a unit of its second digit is 0.05.
PropagationCheck Check(double difference, double accuracy) {
  PropagationCheck check;
  check.done = true;
  check.draws = 1000;
  check.stable = check.validated = true;
  for (IntervalCheck& interval : check.intervals) {
    interval.sigma = 1.2, interval.tolerance = 0.05, interval.accuracy = accuracy;
    interval.agrees = true;
  }
  IntervalCheck& last = check.intervals.back();
  last.high_difference = difference;
  last.agrees = difference <= last.tolerance;
  check.stable = accuracy <= kSettledShare * last.tolerance;
  check.validated = last.agrees;
  return check;
}

TEST(PropagationVerdict,
     TooFewRepetitionsAreUndecidedUnlessTheDifferenceIsLargerThanTheyLeaveOpen) {
  EXPECT_EQ(VerdictOf(Check(0.04, 0.01)), PropagationVerdict::kValidated);
  EXPECT_EQ(VerdictOf(Check(0.06, 0.01)), PropagationVerdict::kDiffers);
  EXPECT_EQ(VerdictOf(Check(0.04, 0.02)), PropagationVerdict::kUndecided);
  EXPECT_EQ(VerdictOf(Check(0.06, 0.02)), PropagationVerdict::kUndecided);
  EXPECT_EQ(VerdictOf(Check(0.08, 0.02)), PropagationVerdict::kDiffers);
  EXPECT_EQ(VerdictOf(Check(std::nan(""), 0.02)), PropagationVerdict::kDiffers);
}

// Standard errors fall with the root of the draws: four times as many for half of it.
TEST(PropagationVerdict, SaysAboutHowManyAreNeeded) {
  EXPECT_EQ(DrawsNeeded(Check(0.04, 0.02)), 4000.0);
  EXPECT_EQ(DrawsNeeded(Check(0.04, 0.033)), 11000.0);  // 10890
  EXPECT_EQ(DrawsNeeded(Check(0.04, 0.001)), 1000.0);
}

}  // namespace
}  // namespace hexcal
