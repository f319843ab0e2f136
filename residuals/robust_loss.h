// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ceres/loss_function.h>

#include <cmath>
#include <memory>
#include <string_view>

namespace hexcal {

enum class LossKind { kNone, kHuber, kCauchy, kTukey };
constexpr std::string_view NameOf(LossKind kind) {
  return kind == LossKind::kHuber    ? "huber"
         : kind == LossKind::kCauchy ? "cauchy"
         : kind == LossKind::kTukey  ? "tukey"
                                     : "none";
}

// rho(s), s the squared norm of a pose's six whitened residuals, in Ceres's conventions: rho(s) = s
// near 0, twice the cost. What lies beyond the scale counts less (Huber, Cauchy) or not at all
// (Tukey, beyond it): P. J. Huber, Robust Statistics (1981).
struct RobustLoss {
  LossKind kind = LossKind::kNone;
  double scale = 1.0;  // sigmas, of sqrt(s); above 0

  // weight = rho'(s): what a row of the pose counts in the normal equations.
  void Evaluate(double s, double* rho, double* weight) const {
    const double limit = scale * scale;
    switch (kind) {
      case LossKind::kNone:
        break;
      case LossKind::kHuber:
        if (s <= limit) break;
        *weight = scale / std::sqrt(s);
        *rho = 2.0 * scale * std::sqrt(s) - limit;
        return;
      case LossKind::kCauchy:
        *weight = 1.0 / (1.0 + s / limit);
        *rho = limit * std::log1p(s / limit);
        return;
      case LossKind::kTukey: {
        // limit / 3 * (1 - (1 - part)^3), without the cancellation near 0
        const double part = s < limit ? s / limit : 1.0;
        *weight = (1.0 - part) * (1.0 - part);
        *rho = limit * part * (1.0 - part * (1.0 - part / 3.0));
        return;
      }
    }
    *weight = 1.0;
    *rho = s;
  }

  double Curvature(double s) const;  // rho''(s): at most 0
};

// The loss at the scale with which it is 95 % efficient where the noise is Gaussian and the
// residual has six dimensions.
RobustLoss DefaultLoss(LossKind kind);

// Ceres's own class for the same loss; null for kNone, as Ceres has it.
std::unique_ptr<ceres::LossFunction> CeresLoss(const RobustLoss& loss);

}  // namespace hexcal
