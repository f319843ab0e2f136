// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/polish.h"

#include <cmath>
#include <limits>

#include "estimator/normal_matrix.h"

namespace hexcal {
namespace {

// Weights that move with the solution make the steps shrink by a factor only.
constexpr int kMaxSteps = 10, kMaxWeightedSteps = 60;
constexpr double kShrinks = 0.5, kShrinksWeighted = 0.9;

}  // namespace

WeightedStep StepFrom(const std::vector<Observation>& observations,
                      const std::vector<Matrix6d>& whiteners,
                      const BaseAndTool& mounts) {
  Matrix12d normal = Matrix12d::Zero();
  Vector12d gradient = Vector12d::Zero();
  for (std::size_t i = 0; i < observations.size(); ++i) {
    const LinearisedError e = Linearise(observations[i], mounts);
    const Matrix6x12d j = whiteners[i] * e.jacobian;
    normal.noalias() += j.transpose() * j;
    gradient.noalias() -= j.transpose() * (whiteners[i] * e.error);
  }
  const Vector12d y = InverseOfNormal(normal) * gradient;
  return {y, 0.5 * y.dot(gradient)};
}

BaseAndTool Moved(const BaseAndTool& mounts, const Vector12d& step) {
  return {Plus(mounts.world_from_base, Vector6d(step.head<6>())),
          Plus(mounts.platform_from_tool, Vector6d(step.tail<6>()))};
}

std::vector<Matrix6d> Weighted(const std::vector<Observation>& observations,
                               const std::vector<Matrix6d>& whiteners,
                               const BaseAndTool& mounts,
                               const RobustLoss& loss) {
  std::vector<Matrix6d> weighted = whiteners;
  if (loss.kind == LossKind::kNone) return weighted;
  for (std::size_t i = 0; i < observations.size(); ++i) {
    const Vector6d e =
        PoseError(mounts, observations[i].base_from_platform, observations[i].world_from_tool);
    double rho, weight;
    loss.Evaluate((whiteners[i] * e).squaredNorm(), &rho, &weight);
    weighted[i] *= std::sqrt(weight);
  }
  return weighted;
}

BaseAndTool Polish(const std::vector<Observation>& observations,
                   const std::vector<Matrix6d>& whiteners,
                   const BaseAndTool& mounts,
                   const RobustLoss& loss) {
  const bool is_plain = loss.kind == LossKind::kNone;
  BaseAndTool best = mounts;
  double last = std::numeric_limits<double>::infinity();
  for (int k = 0; k < (is_plain ? kMaxSteps : kMaxWeightedSteps); ++k) {
    const Vector12d step =
        StepFrom(observations, Weighted(observations, whiteners, best, loss), best).y;
    const double size = step.cwiseAbs().maxCoeff();
    if (!(size < (is_plain ? kShrinks : kShrinksWeighted) * last))
      break;  // rounding is all that is left
    best = Moved(best, step);
    last = size;
  }
  return best;
}

}  // namespace hexcal
