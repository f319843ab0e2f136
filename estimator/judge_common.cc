// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/judge_common.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "estimator/quantiles.h"

namespace hexcal {
namespace {

// Residuals this many times larger or smaller than the stated noise explains put it in doubt, and
// already this many times larger where chance makes them so once in a thousand measurements.
constexpr double kDoubtfulScale = 2.0, kSuspectScale = 1.1, kChance = 1e-3;
// A variance below this part of the other side's is none.
constexpr double kNegligible = 1e-6;

}  // namespace

CovarianceOptions LimitsOf(const Observations& observations, const BaseAndTool& mounts) {
  CovarianceOptions options;
  double size = 1e-3, orientation_variance = 0.0;
  const Eigen::Vector3d first = observations.items[0].world_from_tool.translation;
  for (const Observation& o : observations.items) {
    size = std::max({size,
                     (o.world_from_tool.translation - first).norm(),
                     (o.base_from_platform * mounts.platform_from_tool).translation.norm()});
    orientation_variance += o.robot_covariance.diagonal().tail<3>().mean();
  }
  options.largest_sigma_m = size;
  if (observations.has_robot_noise)
    options.robot_orientation_noise_rad =
        std::sqrt(orientation_variance / static_cast<double>(observations.items.size()));
  return options;
}

Vector6d RobotVariance(const Observations& observations, const BaseAndTool& mounts) {
  const Matrix6d carry = InverseAdjoint(mounts.platform_from_tool);
  Vector6d sum = Vector6d::Zero();
  for (const Observation& o : observations.items)
    sum += (carry * o.robot_covariance * carry.transpose()).diagonal();
  return sum / static_cast<double>(observations.items.size());
}

NoiseSide SideOfNoise(const Vector6d& tracker_variance, const Vector6d& robot_variance) {
  if (robot_variance.isZero(0.0)) return NoiseSide::kTracker;
  const bool is_robot_alone =
      (tracker_variance.array() < kNegligible * robot_variance.array()).all();
  return is_robot_alone ? NoiseSide::kRobot : NoiseSide::kBoth;
}

void AddNoiseDoubts(double scale, double degrees_of_freedom, std::vector<std::string>* warnings) {
  if (scale > kDoubtfulScale ||
      (scale > kSuspectScale &&
       ChiSquareTail(scale * scale * degrees_of_freedom, degrees_of_freedom) < kChance))
    warnings->push_back(
        fmt::format("the residuals are {:.3g} times larger than the stated noise explains: the "
                    "noise is larger, or the model misses something",
                    scale));
  if (scale < 1.0 / kDoubtfulScale)
    warnings->push_back(
        fmt::format("the residuals are {:.3g} times smaller than the stated noise: it is too "
                    "large, and so are the standard deviations",
                    1.0 / scale));
}

}  // namespace hexcal
