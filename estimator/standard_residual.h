// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "estimator/estimate.h"
#include "estimator/observations.h"

namespace hexcal {

// What a fit leaves of one pose, each of the six in its own standard deviations: whitened, and
// divided by the root of its redundancy, for the fit has taken a part. noise, of_fit: covariances
// of the error and of what was fitted to it (J S J'). NaN: the fit has left next to nothing. With a
// fit that is weighted by the noise each is standard normal; those of one pose are a little
// correlated. Reference: R. D. Cook, S. Weisberg, Residuals and Influence in Regression (1982),
// 2.2.
Vector6d StandardResidual(const Vector6d& error, const Matrix6d& noise, const Matrix6d& of_fit);

// Of every pose of an estimate, which is of these observations; NaN for those that were rejected.
// Empty where there is no noise to measure by.
std::vector<Vector6d> StandardResiduals(const Observations& observations, const Estimate& estimate);

}  // namespace hexcal
