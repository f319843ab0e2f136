// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Cholesky>

#include "geometry/pose.h"

namespace hexcal {

// The W with W' W = C^-1 that makes an error of covariance C one of unit variance: C = L L', W =
// L^-1. C must be positive definite.
inline Matrix6d WhitenerOf(const Matrix6d& covariance) {
  return covariance.llt().matrixL().solve(Matrix6d::Identity());
}

}  // namespace hexcal
