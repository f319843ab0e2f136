// SPDX-License-Identifier: BSD-3-Clause
#include "report/plan_words.h"

#include <fmt/format.h>

#include <cmath>

#include "estimator/covariance.h"

namespace hexcal {

std::string ReasonText(const Plan& plan, const PoseReason& reason) {
  if (reason.pair >= 0) {
    const RivalPair& pair = plan.pairs[static_cast<std::size_t>(reason.pair)];
    return fmt::format("tells {} from {}", pair.effect, pair.rival);
  }
  if (reason.parameter < 0) return "adds to all";
  return fmt::format("determines {}", kParameters[static_cast<std::size_t>(reason.parameter)].name);
}

std::string SeparationSentence(const Plan& plan, const RivalPair& pair) {
  switch (pair.separation) {
    case Separation::kAlready:
      return "the measured poses are enough for effects of this size";
    case Separation::kByPlan:
      return "the planned poses tell them apart";
    case Separation::kByMore:
      return fmt::format("the planned poses help, but it takes about {} like them; or: {}",
                         pair.poses_needed,
                         pair.experiment);
    case Separation::kNotByPoses:
      break;
  }
  if (pair.is_absorbed)
    return fmt::format("base and tool alone look the same as this effect; instead: {}",
                       pair.experiment);
  if (pair.is_exact)
    return fmt::format("exactly the same in every pose; instead: {}", pair.experiment);
  return fmt::format(
      "too alike in every pose within reach ({:.1f} if all {} of the pool were "
      "measured); instead: {}",
      pair.whole_pool,
      plan.pool,
      pair.experiment);
}

double ChanceOfMistake(double distance) { return 0.5 * std::erfc(0.5 * distance / std::sqrt(2.0)); }

}  // namespace hexcal
