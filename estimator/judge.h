// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "estimator/estimate.h"
#include "estimator/observations.h"
#include "estimator/sandwich.h"
#include "estimator/variances.h"
#include "residuals/robust_loss.h"

namespace hexcal {

// How the mounts of an estimate were weighted: what a judgement of them must know.
struct Weighting {
  NoiseLevels levels;             // of the tool noise, where the observations do not know it
  bool levels_estimated = false;  // from these residuals
  bool paper_error =
      false;  // equal weights over the paper's pose differences (Eq. 22), else inverse covariances
  RobustLoss loss;
  CovarianceKind covariance = CovarianceKind::kModel;
};

// What the fit has summed up at its solution; nothing where that was another residual's or another
// solver's.
struct FitSums {
  NormalEquations equations;
  std::optional<Variances> variances;
};

// Fills in all that follows from the mounts: residuals, chi-square, covariance, what is not
// determined, warnings.
void Judge(const Observations& observations,
           const Weighting& weighting,
           const std::optional<FitSums>& sums,
           Estimate* estimate);

}  // namespace hexcal
