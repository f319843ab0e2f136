// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geometry/pose.h"
#include "measurement/hexapod_geometry.h"
#include "model/effect.h"
#include "model/pose_map.h"

namespace hexcal {

// All that is needed to predict what the tracker sees.
struct Machine {
  std::string dataset;  // the name of the dataset it was fitted to
  Pose3d world_from_base;
  Pose3d platform_from_tool;
  std::optional<Pose3d> world_from_tracker;  // where it is one for all poses
  std::optional<HexapodGeometry> hexapod;
  std::vector<Effect> effects = {};
  std::optional<PoseMap> pose_map = {};  // of an `unknown`; acts right of base_from_platform
};

// model.yaml (docs/model.md). Reads back what was written, to the last bit.
Machine ReadMachine(const std::string& path);
std::string WriteMachine(const Machine& machine);

}  // namespace hexcal
