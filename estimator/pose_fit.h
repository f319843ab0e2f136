// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "estimator/estimate.h"
#include "estimator/nonlinear.h"
#include "estimator/start.h"
#include "estimator/variances.h"
#include "residuals/pose_batch.h"
#include "residuals/robust_loss.h"
#include "residuals/streamed_residual.h"

namespace hexcal {

struct PoseFitOptions {
  enum class Method {
    kTrustRegion,  // Ceres's solver, with its records
    kTiny,         // Ceres's TinySolver, for small problems by the thousand
    kMoments,      // FitByMoments where it applies, in the fewest passes; else the trust region
  };
  Method method = Method::kTrustRegion;
  NonlinearOptions nonlinear;
  RobustLoss loss;
  int threads = 1;
};

// Base and tool from packed poses, with all that a covariance needs; robot noise, where there is
// any, is in the weights.
struct PoseFit {
  Solution solution;
  NormalEquations equations;  // at the solution
  // Where the levels of the noise were not given: position's and orientation's.
  std::optional<Variances> variances;
};

// weights: of the poses' errors. Nothing: one level for positions and one for orientations, found
// together with the mounts (REML). start: nothing: a closed form of at most kSampleSize poses. From
// kSampleFrom poses on, an even sample of so many is fitted first, so that few passes over all are
// left.
PoseFit FitPoses(const PoseBatch& batch,
                 const PoseWeights* weights,
                 const std::optional<BaseAndTool>& start,
                 const PoseFitOptions& options);

constexpr std::size_t kSampleFrom = 8192;

// (J' W J)^-1 of a fit, zero in the directions that the poses do not determine.
Matrix12d CovarianceOf(const PoseFit& fit);

}  // namespace hexcal
