// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "measurement/dataset.h"
#include "model/machine.h"

namespace hexcal {

struct SimulateOptions {
  std::uint64_t seed = 1;
  double noise = 1.0;  // factor on every stated sigma; 0 for none
};

// What the tracker would see of the dataset's robot poses if the machine were the truth: the
// dataset with its measurement replaced. Markers (rigid bodies only) get the dataset's marker sigma
// along the tracker's axes, tracker.frames times a pose; measured poses get measurement.noise in
// frame T; robot_poses.noise moves the true platform away from the reported pose. InputError where
// the dataset lacks what this needs.
Dataset Simulate(const Dataset& dataset, const Machine& machine, const SimulateOptions& options);

}  // namespace hexcal
