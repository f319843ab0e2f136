// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <limits>

#include "estimator/monte_carlo.h"
#include "estimator/target_error.h"

namespace hexcal {

// The error of a target by repetition against that by first-order propagation (JCGM 101): every
// repetition has base and tool as another measurement would have given them, and its own errors of
// the sources, each of its own distribution, moved exactly.
struct TargetCheck {
  int draws = 0;
  double rms = 0.0, repeated_rms = 0.0;            // m
  double quantile = 0.0, repeated_quantile = 0.0;  // m
  double standard_error = 0.0;                     // of repeated_quantile
  double tolerance = 0.0;                          // half a unit of the RMS's second digit
  int inside = 0;                                  // draws no longer than quantile
  int inside_stated = 0;                           // draws no longer than the stated length
  bool agrees = false;  // quantiles differ by no more than tolerance and two standard errors
  // The repeated length is longer than stated by more than chance, tolerance and twice the relative
  // uncertainty of both and of what is not linear: the statement does not hold.
  bool exceeds_stated = false;
};

// The length that is stated of the place with that probability, and how well it is known.
struct StatedLength {
  double length = 0.0;  // m; 0: none is
  double degrees_of_freedom = std::numeric_limits<double>::infinity();
};

// propagation: with its draws kept, of the same estimate, or of the joint fit of `grown`. The place
// is no row of the dataset. Noise counts as known on both sides: covariance_unscaled. stated: the
// length that is to hold that share of the draws, as it was stated of the place, m.
TargetCheck CheckTarget(const Estimate& estimate,
                        const std::vector<ErrorSource>& sources,
                        const PropagationCheck& propagation,
                        const Pose3d& base_from_platform,
                        const Eigen::Vector3d& p_in_tool,
                        double probability,
                        std::uint64_t seed,
                        const std::shared_ptr<const GrownTarget>& grown = nullptr,
                        const StatedLength& stated = {});

}  // namespace hexcal
