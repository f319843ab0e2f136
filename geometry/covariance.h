// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace hexcal {

// Could m (n x n, in any units) be a covariance, but for rounding? Finite, symmetric, no variance
// negative, and no combination of the n either: judged on correlations, so that metres and radians
// count alike. A variance of zero has zeros only beside it.
bool IsCovariance(const Eigen::MatrixXd& m);

}  // namespace hexcal
