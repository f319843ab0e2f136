// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/polish.h"

#include <limits>

#include "estimator/normal_matrix.h"

namespace hexcal {
namespace {

constexpr int kMaxSteps = 10;

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

BaseAndTool Polish(const std::vector<Observation>& observations,
                   const std::vector<Matrix6d>& whiteners,
                   const BaseAndTool& mounts) {
  BaseAndTool best = mounts;
  double last = std::numeric_limits<double>::infinity();
  for (int k = 0; k < kMaxSteps; ++k) {
    const Vector12d step = StepFrom(observations, whiteners, best).y;
    const double size = step.cwiseAbs().maxCoeff();
    if (!(size < 0.5 * last)) break;  // rounding is all that is left
    best = Moved(best, step);
    last = size;
  }
  return best;
}

}  // namespace hexcal
