// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geometry/pose.h"
#include "measurement/dataset.h"

namespace hexcal {

// One measured world_from_tool (T_T^W) with its covariance as a right perturbation in frame T, [m,
// rad].
struct ToolPose {
  int pose = 0;  // row of robot_poses
  Pose3d world_from_tool;
  Matrix6d covariance = Matrix6d::Zero();  // meaningful where ToolPoses::has_covariance
};

// A pose that was read and cannot be used, since of one body too few markers were seen, or only
// collinear ones.
struct LeftOutPose {
  int pose = 0;  // row of robot_poses
  BodyId body = BodyId::kBase;
  bool is_collinear = false;
};

struct ToolPoses {
  std::vector<ToolPose> poses;  // in the order of robot_poses
  bool has_covariance = false;  // the noise was stated
  // Static tracker: tracker_from_world is one for all poses and its error is common to them. It
  // moves world_from_base alone and is not in ToolPose::covariance. Where the noise was not stated,
  // that error is told by the scatter of the base's readings.
  std::optional<Pose3d> tracker_from_world;
  Matrix6d tracker_from_world_covariance = Matrix6d::Zero();
  std::vector<LeftOutPose> left_out;
  std::vector<std::string> warnings;  // the same in words
};

// Markers to poses (paper, Section 5.1 and Eqs. 33-41; rigid bodies by a weighted fit), or the
// measured poses as they are. Repeated frames of a pose are averaged marker by marker. A pose in
// which fewer than three markers of a body, or only collinear ones, were seen is left out with a
// warning; fewer than three poses left: InputError.
ToolPoses ComputeToolPoses(const Dataset& dataset);

}  // namespace hexcal
