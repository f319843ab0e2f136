// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "measurement/dataset.h"
#include "measurement/tool_pose.h"

namespace hexcal {

// Poses of a tool while its tip rested in a divot, from a file in the style of a dataset
// (docs/pivot.md) or from a table of poses alone.
struct Pivoting {
  // Without a robot: robot_poses has the labels and lines of the poses that the measurement lists.
  Dataset dataset;
  ToolPoses poses;
};

// InputError for everything docs/pivot.md calls bad, and for fewer than three poses.
Pivoting ReadPivoting(const std::string& path);

// A CSV table of poses, which states no units, no noise and no name.
Pivoting ReadPivotingTable(const std::string& path, const Units& units, const std::string& name);

}  // namespace hexcal
