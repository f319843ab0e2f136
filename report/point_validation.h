// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "estimator/estimate.h"
#include "estimator/pose_check.h"

namespace hexcal {

// What poses that were held out say of one point of the tool: how far it was measured from where
// the others predict it, as bias (the mean) and precision (the spread about it), axes of frame W,
// m. The noise of the measurement is in both.
struct PointValidation {
  int poses = 0;
  Eigen::Vector3d bias = Eigen::Vector3d::Zero();
  Eigen::Vector3d precision = Eigen::Vector3d::Zero();  // standard deviation of a coordinate
  double rms = 0.0;                                     // length

  // 1-sigma of each coordinate of the bias, as of independent poses.
  Eigen::Vector3d BiasUncertainty() const { return precision / std::sqrt(std::max(poses, 1)); }

  // In the manner of ISO 9283:1998, 7.2.1, where poses were repeated: the worst of those poses.
  struct Repeated {
    int poses = 0, fewest = 0;   // different ones; how often each at least
    double accuracy = 0.0;       // AP: barycentre of a pose's visits from where it is predicted, m
    double repeatability = 0.0;  // RP: mean distance from the barycentre and three deviations of it
  };
  std::optional<Repeated> repeated;
};

// checks: of used poses. observations: of the same and perhaps others, without effects; predicted
// by mounts. Reported poses are the same where all their numbers are.
PointValidation ValidatePoint(const std::vector<PoseCheck>& checks,
                              const Observations& observations,
                              const BaseAndTool& mounts,
                              const Eigen::Vector3d& p_in_tool);

// Without poses of weight 0: they are no test of a model that is not to explain them.
std::vector<PoseCheck> UsedOf(const std::vector<PoseCheck>& checks, const Estimate& estimate);

}  // namespace hexcal
