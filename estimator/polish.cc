// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/polish.h"

#include <limits>

#include "geometry/linear_algebra.h"

namespace hexcal {
namespace {

constexpr int kMaxSteps = 10;
// Of the normal matrix with unit diagonal: the square of CovarianceOptions::smallest_ratio.
constexpr double kRankThreshold = 1e-12;

}  // namespace

Vector12d GaussNewtonStep(const std::vector<Observation>& observations,
                          const std::vector<Matrix6d>& whiteners,
                          const BaseAndTool& mounts) {
  Matrix12d normal = Matrix12d::Zero();
  Vector12d gradient = Vector12d::Zero();
  for (std::size_t i = 0; i < observations.size(); ++i) {
    const Observation& o = observations[i];
    const Vector6d e = PoseError(mounts, o.base_from_platform, o.world_from_tool);
    const Matrix6x12d j =
        whiteners[i] * PoseErrorJacobian(e, o.base_from_platform * mounts.platform_from_tool);
    normal.noalias() += j.transpose() * j;
    gradient.noalias() -= j.transpose() * (whiteners[i] * e);
  }
  const Vector12d scale = normal.diagonal().cwiseSqrt().cwiseInverse();
  return scale.asDiagonal() *
         Vector12d(ShortestSolution(scale.asDiagonal() * normal * scale.asDiagonal(),
                                    scale.asDiagonal() * gradient,
                                    kRankThreshold));
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
    const Vector12d step = GaussNewtonStep(observations, whiteners, best);
    const double size = step.cwiseAbs().maxCoeff();
    if (!(size < 0.5 * last)) break;  // rounding is all that is left
    best = Moved(best, step);
    last = size;
  }
  return best;
}

}  // namespace hexcal
