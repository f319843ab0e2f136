// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "discovery/discovery.h"
#include "measurement/dataset.h"

namespace hexcal {

// What is left over at every measured pose, in order of visit: what pictures are drawn from. Lists
// are empty or have a row a pose.
struct PoseResiduals {
  struct State {
    std::vector<Vector6d> error;     // measured minus predicted, frame T, [m, rad]
    std::vector<Vector6d> standard;  // in its own standard deviations; NaN: not known; or empty
    std::vector<Vector6d> legs;      // by how much legs would have to be longer, m; or empty
  };
  std::vector<std::string> labels;
  std::vector<bool> used;             // false: without a weight in the fit
  std::vector<double> times;          // s; empty where none were recorded
  std::vector<Vector6d> coordinates;  // of the reported poses, Eq. (2), m and rad; or empty
  State after;
  std::optional<State> before;        // with what discover started from, where it found effects
  std::vector<Vector6d> leg_lengths;  // of the reported poses, m; empty where no legs are known
};

// Of each pose: whether it has a weight in the fit.
std::vector<bool> UsedIn(const Estimate& estimate);

// observations: of the dataset, those that the estimate is of.
PoseResiduals ResidualsOf(const Dataset& dataset,
                          const Observations& observations,
                          const Estimate& estimate);

// Before and after.
PoseResiduals ResidualsOf(const Dataset& dataset, const Discovery& discovery);

}  // namespace hexcal
