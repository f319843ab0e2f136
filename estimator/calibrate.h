// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>

#include "estimator/estimate.h"
#include "estimator/linearized.h"
#include "estimator/nonlinear.h"
#include "estimator/rejection.h"
#include "estimator/sandwich.h"
#include "residuals/robust_loss.h"

namespace hexcal {

enum class Solver { kNonlinear, kLinearized };
enum class Start { kClosedForm, kShah, kParkMartin, kInitial, kIdentity };

// How the nonlinear problem is evaluated: the same solution either way.
enum class Evaluation {
  kStreamed,  // one pass over all poses, from which Ceres gets 13 rows
  kPerPose,   // one automatically differentiated residual block a pose, or reading: the reference
};

struct CalibrateOptions {
  Solver solver = Solver::kNonlinear;
  Evaluation evaluation = Evaluation::kStreamed;
  std::optional<Start>
      start;  // default: closed form; linearized: initial where given, else identity
  std::optional<NoiseLevels> noise;  // in place of a noise that is not given; else it is estimated
  LinearizedOptions linearized;
  NonlinearOptions nonlinear;
  // Of each pose; the nonlinear solver's alone. Levels that are not known are then those of the
  // poses that a search for outliers keeps, and so is the start.
  RobustLoss loss;
  CovarianceKind covariance = CovarianceKind::kModel;  // kSandwich: the nonlinear solver's alone
  OutlierHandling outliers = OutlierHandling::kNotSought;
  OutlierOptions snooping;  // of the search for them
  int threads = 1;          // of the passes over many poses; the result does not depend on it
};

// Base and tool with covariance. Weights are the inverse covariances of the poses; where the tool's
// noise is unknown it is estimated together with the mounts (never set to one). The paper's error
// alone keeps the paper's equal weights, and its covariance is that of the equally weighted
// estimator.
Estimate Calibrate(const Observations& observations,
                   const std::optional<BaseAndTool>& initial,
                   const CalibrateOptions& options);

}  // namespace hexcal
