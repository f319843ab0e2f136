// SPDX-License-Identifier: BSD-3-Clause
#include "report/pose_residuals.h"

#include <algorithm>
#include <unordered_map>

#include "estimator/standard_residual.h"
#include "geometry/rotation_angles.h"
#include "model/hexapod.h"
#include "model/leg_error.h"

namespace hexcal {
namespace {

// By row of the robot's poses, s; nothing where none were recorded.
const std::vector<double>* TimesOf(const Dataset& dataset) {
  const std::vector<Covariate>& covariates = dataset.robot_poses.covariates;
  const auto time = std::find_if(
      covariates.begin(), covariates.end(), [](const Covariate& c) { return c.name == "time"; });
  return time == covariates.end() ? nullptr : &time->values;
}

std::vector<double> TimesOf(const Dataset& dataset, const std::vector<std::string>& labels) {
  const std::vector<double>* all = TimesOf(dataset);
  if (all == nullptr) return {};
  std::unordered_map<std::string, std::size_t> row_of;
  const auto& rows = dataset.robot_poses.rows;
  for (std::size_t i = 0; i < rows.size(); ++i) row_of.emplace(rows[i].label, i);
  std::vector<double> times;
  for (const std::string& label : labels) times.push_back((*all)[row_of.at(label)]);
  return times;
}

}  // namespace

std::vector<bool> UsedIn(const Estimate& estimate) {
  std::vector<bool> used;
  for (const PoseResult& pose : estimate.poses) used.push_back(pose.weight > 0.0);
  return used;
}

PoseResiduals ResidualsOf(const Dataset& dataset,
                          const Observations& observations,
                          const Estimate& estimate) {
  PoseResiduals residuals;
  residuals.used = UsedIn(estimate);
  for (const PoseResult& pose : estimate.poses) {
    residuals.labels.push_back(pose.label);
    residuals.after.error.push_back(pose.residual);
  }
  residuals.after.standard = StandardResiduals(observations, estimate);
  residuals.times = TimesOf(dataset, residuals.labels);
  for (std::size_t i = 0; i < estimate.poses.size(); ++i)
    residuals.coordinates.push_back(VectorFromPose(observations.items[i].base_from_platform));
  if (!dataset.hexapod) return residuals;
  for (std::size_t i = 0; i < estimate.poses.size(); ++i) {
    const Pose3d& base_from_platform = observations.items[i].base_from_platform;
    residuals.leg_lengths.push_back(InverseKinematics(*dataset.hexapod, base_from_platform));
    residuals.after.legs.push_back(
        LegsByError(*dataset.hexapod, base_from_platform, estimate.mounts.platform_from_tool) *
        estimate.poses[i].residual);
  }
  return residuals;
}

PoseResiduals ResidualsOf(const Dataset& dataset, const Discovery& discovery) {
  PoseResiduals residuals;
  PoseResiduals::State before;
  const bool has_legs = !discovery.poses.empty() && discovery.poses.front().leg_lengths.has_value();
  residuals.used.assign(discovery.poses.size(), true);
  if (discovery.estimate.poses.size() == discovery.poses.size())
    residuals.used = UsedIn(discovery.estimate);
  for (const PoseGap& pose : discovery.poses) {
    residuals.labels.push_back(pose.label);
    before.error.push_back(pose.before), residuals.after.error.push_back(pose.after);
    before.standard.push_back(pose.standard_before);
    residuals.after.standard.push_back(pose.standard_after);
    if (!has_legs) continue;
    before.legs.push_back(pose.legs_before), residuals.after.legs.push_back(pose.legs_after);
    residuals.leg_lengths.push_back(*pose.leg_lengths);
  }
  if (discovery.observations.items.size() == discovery.poses.size())
    for (const Observation& observation : discovery.observations.items)
      residuals.coordinates.push_back(VectorFromPose(observation.base_from_platform));
  if (!discovery.effects.empty()) residuals.before = std::move(before);
  residuals.times = TimesOf(dataset, residuals.labels);
  return residuals;
}

}  // namespace hexcal
