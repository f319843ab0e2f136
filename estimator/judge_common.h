// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "estimator/covariance.h"
#include "estimator/estimate.h"
#include "estimator/observations.h"

namespace hexcal {

// What judging a calibration by poses and one by markers have in common.

// No sigma may be longer than the machine is large, and none is told by rotations that are robot
// noise.
CovarianceOptions LimitsOf(const Observations& observations, const BaseAndTool& mounts);

// The robot's share of the variance of the pose error, mean over the poses; frame T, m^2 and rad^2.
Vector6d RobotVariance(const Observations& observations, const BaseAndTool& mounts);

// Which of the two there is.
NoiseSide SideOfNoise(const Vector6d& tracker_variance, const Vector6d& robot_variance);

// Doubts in a stated noise of which the residuals are scale times as large.
void AddNoiseDoubts(double scale, double degrees_of_freedom, std::vector<std::string>* warnings);

}  // namespace hexcal
