// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/moment_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "estimator/moment_start.h"
#include "estimator/polish.h"
#include "estimator/spd_factor.h"
#include "estimator/streamed_solver.h"

namespace hexcal {
namespace {

constexpr double kSafePivot = 1e-8;
constexpr double kGoodMisfit = 1e-2;  // as of a start in estimator/start.cc
constexpr int kMaxPasses = 8;
constexpr double kShrinks = 0.5;
// A step of this many standard deviations needs no other after it. Neither does a small one that
// would be followed by such a one even if steps shrank ten times less than before; it moves the
// covariance by less than 1e-10.
constexpr double kLastStep = 1e-9, kSmallStep = 1e-6, kTenfold = 10.0;

// Base and tool near the solution, and by which factor steps towards it shrink.
struct Near {
  BaseAndTool mounts;
  double rate = 1.0;
};

std::optional<Near> FindNear(const MomentStart& start, const PoseWeights& weights) {
  const std::optional<BaseAndTool> closed = start.ClosedForm();
  if (!closed) return std::nullopt;
  Near near{*closed};
  if (weights.kind() != PoseWeights::Kind::kIsotropic) return near;
  const std::optional<double> rate =
      start.Minimise(weights.position(), weights.orientation(), &near.mounts);
  if (!rate) return std::nullopt;
  near.rate = *rate;
  return near;
}

}  // namespace

std::optional<MomentFit> FitByMoments(const PoseBatch& batch,
                                      const PoseWeights& weights,
                                      int threads) {
  const PoseStream stream(batch, weights, {}, threads);
  const PoseMoments moments = stream.Moments();
  const MomentStart start(moments);
  std::optional<Near> near = FindNear(start, weights);
  if (!near) return std::nullopt;
  MomentFit fit;
  NormalEquations& sums = fit.equations;
  double last = std::numeric_limits<double>::infinity();
  for (int k = 0; k < kMaxPasses; ++k) {
    sums = stream.At(near->mounts);
    if (!(start.Misfit(sums.position_squares, sums.orientation_squares) < kGoodMisfit)) break;
    fit.solution.iterations.push_back(RecordOf(0.5 * sums.squared_norm, sums));
    const SpdFactor<12> factor{Matrix12d(sums.normal)};
    if (!(factor.smallest_pivot() > kSafePivot)) break;
    const Vector12d step = -factor.Solve(sums.gradient);
    const double length = std::sqrt(std::max(0.0, -step.dot(sums.gradient)));
    if (!(length < kShrinks * last)) break;
    near->mounts = Moved(near->mounts, step);
    if (k > 0) near->rate = length / last;
    if (length < kLastStep || (length < kSmallStep && kTenfold * near->rate * length < kLastStep)) {
      fit.solution.mounts = near->mounts;
      fit.solution.converged = true;
      return fit;
    }
    last = length;
  }
  return std::nullopt;
}

}  // namespace hexcal
