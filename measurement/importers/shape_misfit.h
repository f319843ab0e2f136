// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "measurement/importers/recording.h"
#include "measurement/importers/tracked_side.h"

namespace hexcal {

// Where a body's shape is from.
struct ShapeSource {
  std::string path;  // of the file that states it; empty: the mean of the readings in its frame
  bool measured_inverse = false;  // of the mean: the poses state body_from_recording
};

// In words what is odd about a shape (3 x n, m) when it is laid on the readings by a rigid motion a
// row: that it fits ten times better (in variance) with the markers in another order or with its
// axes left-handed, which only a stated one can; or that it does not fit. A mean is held against
// the poses that it was taken with. Empty where it fits.
// sides: one a recording. Looks at rows, spread over all, in which every marker was seen.
std::string OddShape(const std::vector<Recording>& tracker,
                     const std::vector<const TrackedSide*>& sides,
                     const Eigen::Matrix3Xd& shape,
                     const ShapeSource& source);

}  // namespace hexcal
