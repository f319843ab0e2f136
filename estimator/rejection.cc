// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/rejection.h"

#include <fmt/format.h>
#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "estimator/quantiles.h"
#include "estimator/robust_start.h"
#include "residuals/whitener.h"

namespace hexcal {
namespace {

// A part of poses that is no longer a few mistakes.
constexpr double kManyOutliers = 0.2;
// By what part a residual may look smaller than it is, as its pose has drawn the fit to itself: so
// many twelfths of the poses' mean leverage.
constexpr double kDrawn = 24.0;
constexpr double kSmallestPart = 0.5;

std::string LabelsOf(const std::vector<Outlier>& outliers) {
  std::string text;
  for (const Outlier& outlier : outliers) text += (text.empty() ? "" : ", ") + outlier.label;
  return text;
}

void AddWarnings(const Observations& all, OutlierHandling handling, Estimate* estimate) {
  const std::size_t count = estimate->outliers.size(), of = all.items.size();
  if (handling == OutlierHandling::kReject)
    estimate->warnings.push_back(fmt::format(
        "{} of {} poses left out as outliers: {}", count, of, LabelsOf(estimate->outliers)));
  else
    for (const Outlier& outlier : estimate->outliers)
      estimate->warnings.push_back(
          fmt::format(estimate->poses[outlier.index].weight < 1.0
                          ? "pose {} looks like an outlier: {}"
                          : "pose {} looks like an outlier, but is used: {}",
                      outlier.label,
                      outlier.reason));
  if (static_cast<double>(count) > kManyOutliers * static_cast<double>(of))
    estimate->warnings.push_back(fmt::format(
        "{} outliers among {} poses are many: the model may miss something that only some poses "
        "show",
        count,
        of));
}

// Back to where they stood, with weight 0 and what the fit to the others leaves of them.
void InsertPoses(const Observations& all, Estimate* estimate) {
  for (const Outlier& outlier : estimate->outliers) {
    const Observation& o = all.items[outlier.index];
    const Vector6d residual = PoseError(estimate->mounts, o.base_from_platform, o.world_from_tool);
    estimate->poses.insert(estimate->poses.begin() + static_cast<std::ptrdiff_t>(outlier.index),
                           PoseResult{o.label, 0.0, residual});
  }
}

}  // namespace

bool MayHoldOutliers(const Observations& observations,
                     const std::optional<NoiseLevels>& noise,
                     const BaseAndTool& mounts,
                     const OutlierOptions& options) {
  const std::vector<double> squared = SquaredSigmas(observations, noise, mounts);
  const double n = static_cast<double>(squared.size());
  const double limit = ChiSquareQuantile(std::exp(std::log1p(-options.alpha) / n), 6.0) *
                       std::max(kSmallestPart, 1.0 - kDrawn / n);
  return !(*std::max_element(squared.begin(), squared.end()) < limit);
}

Estimate FitAroundOutliers(const Observations& observations,
                           const std::optional<NoiseLevels>& noise,
                           OutlierHandling handling,
                           const OutlierOptions& options,
                           const std::function<Estimate(const Observations&)>& fit) {
  if (handling == OutlierHandling::kNotSought) return fit(observations);
  if (handling == OutlierHandling::kKeep) {
    Estimate estimate = fit(observations);
    if (!MayHoldOutliers(observations, noise, estimate.mounts, options)) return estimate;
    estimate.outliers = FindOutliers(observations, noise, options).outliers;
    if (!estimate.outliers.empty()) AddWarnings(observations, handling, &estimate);
    return estimate;
  }
  std::vector<Outlier> outliers = FindOutliers(observations, noise, options).outliers;
  if (outliers.empty()) return fit(observations);
  Estimate estimate = fit(Without(observations, outliers));
  estimate.outliers = std::move(outliers);
  InsertPoses(observations, &estimate);
  AddWarnings(observations, handling, &estimate);
  return estimate;
}

}  // namespace hexcal
