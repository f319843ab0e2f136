// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "estimator/estimate.h"
#include "measurement/dataset.h"

namespace hexcal {

// What became of the rows of an input: given and absent ones are used, missing or rejected.
struct RowCount {
  std::string input;  // "robot poses", "measured poses", "base/b1"
  long given = 0;     // rows of the table
  long used = 0, missing = 0, rejected = 0;
  // Why, by code: no_reading (a pose that was not measured), not_seen (a row without coordinates),
  // no_row (of a marker, in a frame that has others); too_few_markers, collinear_markers (of a body
  // in the pose), no_weight (an outlier that was rejected, or by the loss).
  std::vector<std::pair<std::string, long>> reasons;
};

// Of the robot's poses and of the measured poses, or of each marker's readings. estimate: of the
// dataset. A tracker that stands still makes one frame of the base's readings in all poses: all
// of them are used.
std::vector<RowCount> CountRows(const Dataset& dataset, const Estimate& estimate);

}  // namespace hexcal
