// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "discovery/constellation.h"
#include "discovery/form_library.h"
#include "discovery/linear_problem.h"
#include "measurement/dataset.h"
#include "model/effect.h"
#include "model/forward.h"
#include "model/visit.h"

namespace hexcal {

// Everything about a dataset that stays the same while the model grows.
struct GapData {
  const Dataset* dataset = nullptr;
  std::optional<HexapodGeometry> hexapod;
  std::vector<Visit> visits;                   // all rows of robot_poses
  ToolPoses tool_poses;                        // as measured
  std::vector<int> rows;                       // of the measured poses
  std::vector<Matrix6d> reported_covariances;  // of the robot's poses, frame A; may be empty
};

// reported: base_from_platform of each row, faults of the data mended.
GapData MakeGapData(const Dataset& dataset, const std::vector<Pose3d>& reported);

// The problem of a machine with these mounts and effects: what it leaves, and what each form would
// explain of that. Also seen: the measured poses rid of what the effects say of the tracker.
struct GapProblem {
  LinearProblem linear;
  Eigen::MatrixXd trend;  // 6 poses x 12: base and tool drifting, for the noise model
  std::vector<SeenPose> seen;
  std::vector<Pose3d> predicted;        // world_from_tool of each measured pose
  std::vector<Matrix6d> legs_by_error;  // the pose error in leg space, m; empty without legs
};
GapProblem MakeGapProblem(const GapData& data,
                          const Mounts& mounts,
                          const std::vector<Effect>& effects,
                          const FormLibrary& library);
// The same; nothing where the effects put legs out of reach.
std::optional<GapProblem> MakeGapProblemInReach(const GapData& data,
                                                const Mounts& mounts,
                                                const std::vector<Effect>& effects,
                                                const FormLibrary& library);

}  // namespace hexcal
