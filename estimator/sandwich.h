// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "estimator/covariance.h"
#include "estimator/observations.h"
#include "residuals/robust_loss.h"

namespace hexcal {

enum class CovarianceKind {
  kModel,     // of the noise that weighs the poses, or of what the loss makes of it
  kSandwich,  // SandwichCovariance
};

// Covariance of the mounts that does not believe the noise model: B^-1 (sum g_i g_i') B^-1, g_i =
// J_i' w_i r_i the gradient of pose i (its six residuals may be correlated in any way), B = sum (w
// + s rho''(s) / 3) J_i' J_i, r and J whitened, s = |r|^2. Right where the weights are not: noise
// that differs from pose to pose, or is misjudged. r_i is first divided by the root of 1 - its
// leverage, so that the result is unbiased where the model does hold. Zero on directions that the
// data do not determine. References: H. White, Econometrica 48 (1980); P. J. Huber, Robust
// Statistics (1981), sec. 7.6; R. M. Bell, D. F. McCaffrey, Survey Methodology 28 (2002) (CR2).
Matrix12d SandwichCovariance(const Observations& observations,
                             const BaseAndTool& mounts,
                             const NoiseLevels& levels,
                             const RobustLoss& loss);

// What (sum w J_i' J_i)^-1 is to be multiplied with under a loss, where the noise is the same for
// all poses but for its outliers: (a / (1 - 2 / W)) W / b^2, a = sum w^2 s / 6, b = sum (w + s
// rho'' / 3), W = sum w. Without a loss it is noise_scale^2. Reference: Huber (1981), sec. 7.6.
double LossCovarianceFactor(const Observations& observations,
                            const BaseAndTool& mounts,
                            const NoiseLevels& levels,
                            const RobustLoss& loss);

}  // namespace hexcal
