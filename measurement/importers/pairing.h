// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "measurement/importers/assemble.h"

namespace hexcal {

// A row of one of the tracker's files.
struct TrackerRow {
  std::size_t file = 0;
  std::size_t row = 0;
};

// For each row of the robot's file the tracker's rows that belong to it. InputError where the
// files do not go together in the way that options.pairing says, or where it says nothing (the
// message names what would fit).
std::vector<std::vector<TrackerRow>> PairRows(const Recording& robot,
                                              const std::vector<Recording>& tracker,
                                              const AssembleOptions& options);

}  // namespace hexcal
