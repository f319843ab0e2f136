// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/plausibility.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

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

std::string WhyNothingCounts(const std::vector<Observation>& observations,
                             const std::vector<Matrix6d>& whiteners,
                             const BaseAndTool& mounts,
                             const RobustLoss& loss) {
  std::size_t counted = 0;
  for (std::size_t i = 0; i < observations.size(); ++i) {
    const Observation& o = observations[i];
    const Vector6d e = PoseError(mounts, o.base_from_platform, o.world_from_tool);
    double rho, weight;
    loss.Evaluate((whiteners[i] * e).squaredNorm(), &rho, &weight);
    counted += weight > 0.0;
  }
  if (6 * counted > 12) return "";
  return fmt::format(
      "the loss {} leaves {} of {} poses a weight, too few for base and tool: its scale of {} "
      "sigma "
      "is smaller than the noise, or the noise is larger than stated (--loss_scale)",
      NameOf(loss.kind),
      counted,
      observations.size(),
      loss.scale);
}

}  // namespace hexcal
