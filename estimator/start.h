// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "estimator/observations.h"
#include "residuals/pose_error.h"

namespace hexcal {

// Mean squared pose error in units of the poses' own spread, dimensionless: near 0 where base and
// tool explain the poses, near 1 and above where they explain nothing.
struct Misfit {
  double position = 0.0, orientation = 0.0;
  double Total() const { return position + orientation; }
};
Misfit MisfitOf(const std::vector<Observation>& observations, const BaseAndTool& mounts);

// At most so many rows, evenly taken: enough for what need not see all of many.
constexpr std::size_t kSampleSize = 1024;
std::vector<Observation> EvenSample(const std::vector<Observation>& observations,
                                    std::size_t at_most = kSampleSize);

// Base and tool from nothing, near enough for the iterative solvers: the first closed form that
// fits. Where none fits (rotations about one axis, by half turns or none at all leave more than one
// base rotation, among which only the positions decide) it is searched for from all around.
BaseAndTool FindStart(const std::vector<Observation>& observations);

}  // namespace hexcal
