// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "estimator/grown_solution.h"
#include "estimator/observations.h"

namespace hexcal {

// What the other poses say of one, and how large an error of it they would see.
struct PoseCheck {
  std::string label;
  Vector6d held_out = Vector6d::Zero();  // measured minus predicted by the others, [m, rad]
  double squared = 0.0;                  // the same in squared sigmas: chi-square of 6
  double expected_position = 0.0;        // RMS length of held_out that noise explains, m
  double expected_orientation = 0.0;     // rad
  // The smallest error, along the worst direction, that the search for outliers would find, m and
  // rad.
  double smallest_position = 0.0;
  double smallest_orientation = 0.0;
  double redundancy = 0.0;  // the part of an error that shows in the residual, mean of the six
};

// For every pose that the others check, by its deletion error (estimator/deletion.h). Smallest
// errors: the test of FindOutliers at alpha for all poses together finds them with that power.
// levels: where the dataset states no noise. weighted: how the fit of these mounts weighed the
// poses; of a pose of weight 0 the fit has seen nothing, and it is compared with the prediction as
// it is. Reference: W. Baarda, A Testing Procedure for Use in Geodetic Networks (1968), for six
// dimensions at a time.
struct WeightedAs {
  std::vector<double> weights;  // of each pose, held; empty: 1
  double variance = 1.0;        // of the 12, over that of the weights (Huber 1981, 7.6)
};
std::vector<PoseCheck> CheckPoses(const Observations& observations,
                                  const BaseAndTool& mounts,
                                  const NoiseLevels& levels,
                                  double alpha,
                                  double power,
                                  const WeightedAs& weighted = {});

// The same with the effects of a model fitted along with base and tool. What a pose's markers say
// within their bodies stays in the fit without it.
std::vector<PoseCheck> CheckPoses(const GrownSolution& solution, double alpha, double power);

}  // namespace hexcal
