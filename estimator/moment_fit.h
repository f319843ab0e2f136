// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "estimator/estimate.h"
#include "residuals/pose_stream.h"

namespace hexcal {

// The solution with the equations at it, as of SolveStreamed.
struct MomentFit {
  Solution solution;
  NormalEquations equations;
};

// Base and tool from nothing in the fewest passes: one for the poses' moments (MomentStart), then
// Gauss-Newton steps over the poses until nothing moves, mostly one or two. For poses without a
// loss. Nothing wherever a step does not do as expected, poses are explained no better than by a
// wrong basin or a direction is weak: FindStart and the trust region look after these.
std::optional<MomentFit> FitByMoments(const PoseBatch& batch,
                                      const PoseWeights& weights,
                                      int threads);

}  // namespace hexcal
