// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "measurement/dataset.h"
#include "model/visit.h"

namespace hexcal {

// What drives effects at a place that the rows of a dataset did not visit: as if the robot went
// there once more after the last of them, from the centre of the travel, and stood still: that
// row's time, no velocity, and the mean over the rows of all else (temperature, payload, ...). A
// leg that need not move counts as having come from a shorter length.
class PlaceVisits {
 public:
  // hexapod: null where there is none. home: the centre of the travel. At least one row.
  PlaceVisits(const Dataset& dataset, const HexapodGeometry* hexapod, const Pose3d& home);

  Visit At(const Pose3d& base_from_platform) const;

 private:
  Dataset one_row_;
  std::optional<HexapodGeometry> hexapod_;
  int last_row_;
};

}  // namespace hexcal
