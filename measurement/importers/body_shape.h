// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "measurement/dataset.h"
#include "measurement/importers/recording.h"
#include "measurement/importers/tracked_side.h"

namespace hexcal {

// The markers of a body for a dataset, and where their coordinates are from, in words.
struct BodyShape {
  MarkerBody body;
  std::string origin;
  std::vector<std::string> warnings;
};

// Whether there is a way to a shape: a file of it, the body's poses, or just three markers.
bool HasShape(const TrackedSide& side, const std::optional<StatedShape>& stated);

// The shape that a file states; else the means of the markers in the tracker's own frame of the
// body, over all rows in which both were seen; else the paper's frame of three markers. sides: one
// a recording. prefix: of the markers' names, where they have none of their own. InputError where
// the numbers of markers differ, a marker is never seen, or all are on a line.
BodyShape MakeBodyShape(const std::vector<Recording>& tracker,
                        const std::vector<const TrackedSide*>& sides,
                        const std::optional<StatedShape>& stated,
                        bool measured_inverse,
                        const char* prefix);

}  // namespace hexcal
