// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "estimator/observations.h"
#include "residuals/pose_error.h"

namespace hexcal {

struct OutlierOptions {
  // The probability that a dataset without any outlier lists one or more; in (0, 1).
  double alpha = 0.01;
};

// A pose that base and tool from the other poses do not explain.
struct Outlier {
  std::size_t index = 0;  // among the observations
  std::string label;
  std::string reason;                    // in words
  Vector6d residual = Vector6d::Zero();  // measured [-] predicted by the others, [m, rad]
  double position_sigmas = 0.0;          // its length in sigmas of noise and prediction
  double orientation_sigmas = 0.0;       // the same
  double statistic = 0.0;                // squared sigmas of all six, studentised
  double p_value = 0.0;                  // that the worst of so many clean poses is as far off
};

struct OutlierSearch {
  std::vector<Outlier> outliers;  // in the order of the observations
  BaseAndTool mounts;             // the fit to the other poses
  NoiseLevels levels;             // and its noise, as estimated or as given
};

// Data snooping that neither masking nor swamping spoils: the fit to the best half
// (FindRobustStart) grows to all poses that agree with it, then the worst is taken out as long as
// it is significant and the best of those left out is taken back as long as it is not, with a new
// fit each time. A pose is judged by what the others predict for it (deletion residual, six degrees
// of freedom; chi-square for a stated noise, F for an estimated one), at the level 1 - (1 -
// alpha)^(1/n) that makes alpha that of all n poses (Sidak). At most as many as leave HalfOfPoses.
// Fewer than six poses are fitted only. A stated noise that the poses which agree disprove counts
// as known but for a factor. References: W. Baarda, A Testing Procedure for Use in Geodetic
// Networks (1968); A. S. Hadi, J. S. Simonoff, J. American Statistical Association 88 (1993).
OutlierSearch FindOutliers(const Observations& observations,
                           const std::optional<NoiseLevels>& noise,
                           const OutlierOptions& options);

// The observations but for these.
Observations Without(const Observations& observations, const std::vector<Outlier>& outliers);

}  // namespace hexcal
