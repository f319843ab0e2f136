// SPDX-License-Identifier: BSD-3-Clause
#include "report/change.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "estimator/mount_change.h"
#include "estimator/target_error.h"

namespace hexcal {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// Of the poses that have a weight.
std::vector<std::string> UsedReadings(const Estimate& estimate, const DatasetReadings& readings) {
  std::vector<std::string> used;
  std::size_t row = 0;
  for (const PoseResult& pose : estimate.poses) {
    while (row < readings.size() && readings[row].pose != pose.label) ++row;
    if (row == readings.size()) return {};
    if (pose.weight > 0.0) used.push_back(HexOf(readings[row].hash));
  }
  return used;
}

// Beyond anything that was measured.
bool IsOfExactData(const Matrix12d& covariance) {
  constexpr double kRounding = 1e-12;  // m, rad
  return std::sqrt(covariance.diagonal().maxCoeff()) < kRounding;
}

// One standard deviation of how far the point has moved, along that way.
double SigmaOfMove(const EarlierResult& earlier,
                   const Estimate& now,
                   const Pose3d& centre,
                   const Eigen::Vector3d& p_in_tool,
                   const Eigen::Vector3d& moved) {
  const auto variance = [&](const BaseAndTool& mounts, const Matrix12d& covariance) {
    const Vector12d j = TargetJacobian(mounts, centre, p_in_tool).transpose() * moved.normalized();
    return j.dot(covariance * j);
  };
  return std::sqrt(variance(earlier.mounts, earlier.covariance) +
                   variance(now.mounts, now.covariance));
}

}  // namespace

Change ChangeOf(const EarlierResult& earlier,
                const Estimate& now,
                const DatasetReadings& readings,
                const std::vector<NamedPoint>& points,
                const Pose3d& centre) {
  Change change;
  change.earlier = earlier;
  change.shared = Share(UsedReadings(now, readings), earlier.readings);
  const MountChange found =
      ChangeBetween({earlier.mounts, earlier.covariance, earlier.determined},
                    {now.mounts, now.covariance, now.observability.determined});
  change.difference = found.difference;
  for (int i = 0; i < 12; ++i)
    change.over_own[i] = now.observability.determined[i]
                             ? change.difference[i] / std::sqrt(now.covariance(i, i))
                             : kNaN;
  change.is_of_exact = IsOfExactData(earlier.covariance) || IsOfExactData(now.covariance);
  const bool is_independent = change.IsTested();
  change.sigmas = is_independent ? found.sigmas : Vector12d::Constant(kNaN).eval();
  change.chi_square = is_independent ? found.chi_square : kNaN;
  change.p_value = is_independent ? found.p_value : kNaN;
  const auto predicted = [&](const BaseAndTool& mounts, const NamedPoint& point) {
    return Eigen::Vector3d(mounts.world_from_base * centre * mounts.platform_from_tool *
                           point.p_in_tool);
  };
  const bool is_determined = std::all_of(
      change.sigmas.begin(), change.sigmas.end(), [](double s) { return std::isfinite(s); });
  for (const NamedPoint& point : points) {
    const Eigen::Vector3d moved = predicted(now.mounts, point) - predicted(earlier.mounts, point);
    change.at_points.push_back(moved.norm());
    change.sigma_at_points.push_back(
        is_determined ? SigmaOfMove(earlier, now, centre, point.p_in_tool, moved) : kNaN);
  }
  return change;
}

std::string WordsOf(const SharedReadings& shared) {
  if (!shared.is_known)
    return "The earlier result does not say which readings it used: the two count as independent, "
           "which holds only where no reading is in both.";
  if (shared.poses == 0)
    return "No pose has the same readings in both: the two count as independent.";
  const bool is_all = shared.poses == shared.of && shared.poses == shared.earlier_of;
  return fmt::format(
      "Both used the very same readings of {} (of {} used now and {} used then), so that they are "
      "not independent: the covariance of their difference is not the sum of theirs, and no "
      "probability is given. {}",
      shared.poses == 1 ? "one pose" : fmt::format("{} poses", shared.poses),
      shared.of,
      shared.earlier_of,
      is_all ? "No noise of a measurement is in the change: it is what settings, version or what "
               "else the datasets state make of the same readings."
             : "Settings, version and the readings that are not in both have made the change.");
}

}  // namespace hexcal
