// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "measurement/dataset.h"

namespace hexcal {

// By which the readings of a pose are known again in another calibration: a hash of their numbers,
// in whatever order, whatever the names of marker and pose. Poses of another hash differ in a digit
// or in which markers were seen. 0: none.
struct PoseReadings {
  std::string pose;
  std::uint64_t hash = 0;
};
using DatasetReadings = std::vector<PoseReadings>;  // in the order of robot_poses

DatasetReadings ReadingsOf(const Dataset& dataset);

std::string HexOf(std::uint64_t hash);  // 16 digits

// What two calibrations have in common.
struct SharedReadings {
  bool is_known = false;        // both say which readings they used
  long poses = 0;               // used in both with the very same readings
  long of = 0, earlier_of = 0;  // poses used now, and then
};

// Hashes of the poses that each used, as HexOf; empty: not known.
SharedReadings Share(std::vector<std::string> now, std::vector<std::string> earlier);

}  // namespace hexcal
