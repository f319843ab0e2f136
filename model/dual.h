// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <unsupported/Eigen/AutoDiff>

namespace hexcal {

// A number with its derivative by one parameter.
using Dual = Eigen::AutoDiffScalar<Eigen::Matrix<double, 1, 1>>;

}  // namespace hexcal
