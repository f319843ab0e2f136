// SPDX-License-Identifier: BSD-3-Clause
#include "residuals/robust_loss.h"

namespace hexcal {

double RobustLoss::Curvature(double s) const {
  const double limit = scale * scale;
  switch (kind) {
    case LossKind::kNone:
      break;
    case LossKind::kHuber:
      return s > limit ? -0.5 * scale / (s * std::sqrt(s)) : 0.0;
    case LossKind::kCauchy:
      return -1.0 / (limit * std::pow(1.0 + s / limit, 2));
    case LossKind::kTukey:
      return s < limit ? -2.0 / limit * (1.0 - s / limit) : 0.0;
  }
  return 0.0;
}

// The estimate of a location in p dimensions, residual r, weight w(r), has the efficiency
// E[w + r w' / p]^2 / E[w^2 r^2 / p] under r^2 ~ chi^2 with p degrees of freedom (Hampel,
// Ronchetti, Rousseeuw, Stahel, Robust Statistics (1986), sec. 5.2); for p = 6 it is 0.95 at these
// scales. Those in textbooks (1.345, 2.385, 4.685) are for p = 1.
RobustLoss DefaultLoss(LossKind kind) {
  switch (kind) {
    case LossKind::kNone:
      break;
    case LossKind::kHuber:
      return {kind, 1.8693377293};
    case LossKind::kCauchy:
      return {kind, 2.8623720282};
    case LossKind::kTukey:
      return {kind, 6.3562162897};
  }
  return {};
}

std::unique_ptr<ceres::LossFunction> CeresLoss(const RobustLoss& loss) {
  switch (loss.kind) {
    case LossKind::kNone:
      break;
    case LossKind::kHuber:
      return std::make_unique<ceres::HuberLoss>(loss.scale);
    case LossKind::kCauchy:
      return std::make_unique<ceres::CauchyLoss>(loss.scale);
    case LossKind::kTukey:
      return std::make_unique<ceres::TukeyLoss>(loss.scale);
  }
  return nullptr;
}

}  // namespace hexcal
