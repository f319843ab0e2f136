// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "measurement/dataset.h"

namespace hexcal {

// Covariates that are set together (a load with its centre, the six velocities, the legs' last
// directions, or one alone), and what they may be set to.
struct CovariateGroup {
  std::vector<int> columns;                   // in robot_poses.covariates
  std::vector<std::vector<double>> settings;  // values of these columns
};

// What a dataset's own table shows can be set: up to five different rows all of them, else those
// that are lowest or highest in a column and the one in the middle. Legs may also be reached all
// from above or all from below. `time` passes by itself and is in no group.
// Columns in `chosen` stand alone and take these values (SI) in their place.
using ChosenSettings = std::map<std::string, std::vector<double>>;
std::vector<CovariateGroup> CovariateSettings(const Dataset& dataset, const ChosenSettings& chosen);

}  // namespace hexcal
