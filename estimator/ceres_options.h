// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ceres/solver.h>

#include "estimator/nonlinear.h"

namespace hexcal {

// Levenberg-Marquardt with dense QR, silent, one thread, without a tolerance on the gradient.
ceres::Solver::Options CeresOptions(const NonlinearOptions& options);

}  // namespace hexcal
