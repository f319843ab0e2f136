// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "estimator/observations.h"
#include "residuals/pose_error.h"

namespace hexcal {

// Mounts that fit the better half of the poses, whatever the others are.
struct RobustStart {
  BaseAndTool mounts;
  NoiseLevels levels;                // from the medians of all poses; the noise where it was given
  std::vector<std::size_t> nearest;  // the poses that it fits best, a little more than half
};

// Poses in RobustStart::nearest: what is left when as many as possible are wrong.
std::size_t HalfOfPoses(std::size_t poses);

// The least median of pose errors over closed forms of random fours, and of the fits that follow
// when only the nearest half is kept (concentration). Errors are whitened where the noise is known
// (noise: in place of one that is not). Where it is not, what is least is the product of the
// medians of position and of orientation errors, so that neither unit nor ratio of the two
// matters. Random draws are the same in every run. At least four poses.
// References: P. J. Rousseeuw, J. American Statistical Association 79 (1984); P. J. Rousseeuw, K.
// Van Driessen, Data Mining and Knowledge Discovery 12 (2006).
RobustStart FindRobustStart(const Observations& observations,
                            const std::optional<NoiseLevels>& noise);

// Squared lengths of the poses' errors at mounts, in sigmas of the known noise, or of levels from
// the medians.
std::vector<double> SquaredSigmas(const Observations& observations,
                                  const std::optional<NoiseLevels>& noise,
                                  const BaseAndTool& mounts);

// 1-sigma of one coordinate from the median length of n three-dimensional errors left by a fit of
// 12 parameters to n poses.
double SigmaFromMedian(double median, std::size_t n);

}  // namespace hexcal
