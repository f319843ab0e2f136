// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/mount_change.h"

#include <cmath>
#include <limits>

#include "estimator/quantiles.h"
#include "estimator/spd_factor.h"

namespace hexcal {

Vector12d Minus(const BaseAndTool& now, const BaseAndTool& earlier) {
  Vector12d difference;
  difference << Minus(now.world_from_base, earlier.world_from_base),
      Minus(now.platform_from_tool, earlier.platform_from_tool);
  return difference;
}

MountChange ChangeBetween(const KnownMounts& earlier, const KnownMounts& now) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  MountChange change;
  change.difference = Minus(now.mounts, earlier.mounts);
  const Matrix12d covariance = now.covariance + earlier.covariance;
  bool all = true;
  for (int i = 0; i < 12; ++i) {
    const bool is_determined = now.determined[i] && earlier.determined[i];
    all = all && is_determined;
    change.sigmas[i] = is_determined ? change.difference[i] / std::sqrt(covariance(i, i)) : kNaN;
  }
  change.chi_square = change.p_value = kNaN;
  const SpdFactor<12> factor(covariance);
  if (all && factor.smallest_pivot() > 0.0) {
    change.chi_square = change.difference.dot(factor.Solve(change.difference));
    change.p_value = ChiSquareTail(change.chi_square, 12.0);
  }
  return change;
}

}  // namespace hexcal
