// SPDX-License-Identifier: BSD-3-Clause
#include "testing/discoveries.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace hexcal::testing {
namespace {

constexpr int kPoses = 24;

DiscoveredEffect LegGain() {
  DiscoveredEffect found;
  found.effect.name = "leg_gain";
  found.effect.index = {3};
  found.effect.parameters = found.effect.standard_deviation = Vector6d::Zero();
  found.effect.parameters[2] = 3.125e-4;
  found.effect.standard_deviation[2] = 1.25e-5;
  found.site = "leg";
  found.driver = "leg_length";
  found.shape = "linear";
  found.labels = {"leg 3"};
  found.p_value = 0.001;
  found.log10_p = -41.5;
  found.gap_closed = 0.875;
  found.could_also_be = {{"base_radius", "poses of other heights would tell them apart"}};
  found.description = "Leg 3 moves 312 ppm further than it reports.";
  return found;
}

DiscoveredEffect MarkerOffset() {
  DiscoveredEffect found;
  found.effect.name = "marker_offset";
  found.effect.index = {6};
  found.effect.parameters = Eigen::Vector3d(1e-4, -2e-4, 3e-4);
  found.effect.standard_deviation =
      Eigen::Vector3d(1e-5, 2e-5, std::numeric_limits<double>::quiet_NaN());
  found.site = "marker";
  found.driver = "constant";
  found.shape = "constant";
  found.labels = {"tool/t2"};
  found.p_value = 0.002;
  found.log10_p = -12.25;
  found.gap_closed = 0.9375;
  return found;
}

PoseGap PoseOf(int i) {
  PoseGap pose;
  pose.label = fmt::format("p{}", i + 1);
  pose.row = i;
  for (int k = 0; k < 6; ++k) {
    pose.before[k] = 2e-4 * std::sin(0.7 * i + k);
    pose.after[k] = 2e-5 * std::cos(1.9 * i + 2 * k);
    pose.standard_before[k] = 4.0 * std::sin(0.7 * i + k);
    pose.standard_after[k] = 1.5 * std::cos(1.9 * i + 2 * k);
    pose.legs_before[k] = (k == 2 ? 3e-4 : 3e-5) * std::sin(0.5 * i + k);
    pose.legs_after[k] = 2.5e-5 * std::cos(2.3 * i + k);
  }
  pose.leg_lengths =
      Vector6d::Constant(0.3) + 0.02 * Vector6d::LinSpaced(std::sin(0.5 * i), std::cos(0.4 * i));
  pose.weight = i == 4 ? 0.25 : 1.0;
  return pose;
}

Where MakeWhere() {
  Where where;
  where.poses = {{"pose p7", 0.0004, 0.31}, {"pose p2", 0.8, 0.02}};
  where.legs = {{"leg 3", 1e-12, 0.81}, {"leg 1", 0.5, 0.05}};
  where.axes = {{"base x", 0.04, 0.2}};
  where.covariates = {{"leg length", 1e-9, 0.7}};
  where.sites = {{"leg", 1e-15, 0.9}, {"tracker", 0.3, 0.1}};
  return where;
}

Estimate MakeEstimateOf(double noise_scale) {
  Estimate estimate;
  estimate.converged = true;
  estimate.noise_scale = noise_scale;
  for (int i = 0; i < 12; ++i) {
    estimate.covariance(i, i) = std::pow(1e-5 * (i + 1), 2);
    estimate.observability.determined[i] = true;
  }
  return estimate;
}

}  // namespace

Discovery MakeDiscovery() {
  Discovery discovery;
  discovery.verdict = Verdict::kExplained;
  discovery.not_testable = {{"leg_thermal", "a temperature column"}};
  discovery.detectable = {{"leg_backlash", {2}, "m", 4.5e-6}, {"tracker_scale", {}, "1", 2.5e-5}};
  discovery.gap = {{1.5e-4, 1.25e-3, 900.0, 420},
                   {5e-5, 4e-4, 400.0, 418},
                   {1.75e-4, 1.375e-3, 950.0, 432},
                   {5.5e-5, 4.5e-4, 450.0, 432},
                   {4.5e-5, 3.5e-4, 432.0, 432}};
  discovery.effects = {LegGain(), MarkerOffset()};
  const GapSize between = {8e-5, 6e-4, 600.0, 419};
  discovery.steps = {
      {{{"leg_gain", {3}, 86.5, 1e-12, -12.0}, {"base_radius", {}, 80.25, 1e-11, -11.0}},
       "leg_gain",
       0.001,
       between},
      {{{"marker_offset", {6}, 30.5, 1e-6, -6.0}}, "marker_offset", 0.002, discovery.gap.after},
      {{{"tool_sag", {}, -2.5, 0.25, -0.6}}, "", 0.75, discovery.gap.after}};
  discovery.where = MakeWhere();
  discovery.noise = {1.125, 2e-6, 3e-5, 5.0, 0.25, 1.0625};
  for (int i = 0; i < kPoses; ++i) discovery.poses.push_back(PoseOf(i));
  discovery.base_and_tool = MakeEstimateOf(1.5);
  discovery.estimate = MakeEstimateOf(1.0);
  for (const PoseGap& pose : discovery.poses) {
    Observation seen;
    seen.label = pose.label;
    seen.base_from_platform.translation << 1e-3 * pose.row, 0.0, 0.25;
    seen.world_from_tool = seen.base_from_platform;
    discovery.observations.items.push_back(seen);
    discovery.estimate.poses.push_back({pose.label, 1.0, pose.after});
  }
  discovery.base_and_tool.iterations = {{900.0, 1e-3, 1e-2}, {450.0, 1.5e-4, 1.25e-3}};
  discovery.refit = {{450.0, 1.5e-4, 1.25e-3}, {200.0, 5e-5, 4e-4}};
  discovery.warnings = {"a warning"};
  return discovery;
}

Dataset DatasetOf(const Discovery& discovery) {
  Dataset dataset;
  dataset.name = "demo";
  dataset.measurement.emplace();
  Covariate time{"time", {}, {}};
  for (const PoseGap& pose : discovery.poses) {
    dataset.robot_poses.rows.push_back({pose.label, {}, {}, 0});
    time.values.push_back(60.0 * pose.row);
  }
  dataset.robot_poses.covariates = {time};
  return dataset;
}

}  // namespace hexcal::testing
