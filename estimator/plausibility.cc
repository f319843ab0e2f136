// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/plausibility.h"

#include <algorithm>
#include <cmath>

#include "estimator/start.h"

namespace hexcal {
namespace {

// With more than this part of the poses' squared spread left over nothing is explained.
constexpr double kNoFit = 0.5;
// Misfit by which another start must be better to show that a solution is none.
constexpr double kMuchBetter = 0.25;
constexpr double kRoundings = 64.0;
// Part of the poses' squared spread: a local minimum is a turn of their size away from the best one
// and leaves far more. What stops by its tolerance on exact data may leave less.
constexpr double kSmallestLocal = 1e-8;

// What rounding alone leaves: nothing is better than that.
double RoundingMisfit(const std::vector<Observation>& observations) {
  const NoiseLevels rounding = Rounding(observations), spread = Spread(observations);
  return std::pow(kRoundings * rounding.position / spread.position, 2) +
         std::pow(kRoundings * rounding.orientation / spread.orientation, 2);
}

}  // namespace

std::string WhyNoSolution(const std::vector<Observation>& observations,
                          const BaseAndTool& mounts,
                          bool could_be_local) {
  const Misfit misfit = MisfitOf(observations, mounts);
  if (misfit.position > kNoFit && misfit.orientation > kNoFit)
    return "no base and tool explain how the poses move: they hardly do, some are grossly wrong, "
           "or units, rotations or the order of the rows are";
  if (could_be_local && misfit.Total() > std::max(RoundingMisfit(observations), kSmallestLocal) &&
      MisfitOf(observations, FindStart(observations)).Total() < kMuchBetter * misfit.Total())
    return "it ended in a local minimum: --start=closed_form finds a better one";
  return "";
}

}  // namespace hexcal
