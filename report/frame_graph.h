// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "measurement/dataset.h"
#include "report/html/page.h"

namespace hexcal {

// What the picture of the frames needs to know.
struct FrameGraph {
  // Markers of the base and of the tool; nothing where poses were measured. No markers on the base:
  // W is the tracker's own frame.
  std::optional<std::array<std::size_t, 2>> markers;
  bool tracker_is_static = false;
  bool are_leg_lengths = false;     // recorded of the robot, in place of poses
  std::vector<std::string> points;  // of the tool, named; may be none
};
FrameGraph FrameGraphOf(const Dataset& dataset, std::vector<std::string> points);

// W, B, A, T and the tracker, and which of the transforms between them is known, which measured and
// which estimated. An SVG of 360 units' width in the page's colours.
Drawing FrameGraphDrawing(const FrameGraph& graph);

}  // namespace hexcal
