// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "geometry/pose.h"
#include "measurement/dataset.h"
#include "model/machine.h"

namespace hexcal {

// base_from_platform of every row of robot_poses, as reported: the recorded pose, or forward
// kinematics of the recorded leg lengths, started from the neutral pose and, should that fail, from
// the row before. InputError with file and line where legs reach no pose or there is no hexapod.
std::vector<Pose3d> ReportedPoses(const Dataset& dataset);

// As above, with another hexapod than the dataset's (a calibrated one).
std::vector<Pose3d> ReportedPoses(const RobotPoses& robot_poses, const HexapodGeometry& hexapod);

// As the machine sees them: faults of the data among its effects mended, legs by its hexapod where
// it has one.
std::vector<Pose3d> ReportedPoses(const Dataset& dataset, const Machine& machine);

// 6x6 covariance of each reported pose in frame A, from noise: {position, orientation} or noise:
// {leg}; empty when neither is given (the robot is taken as exact).
std::vector<Matrix6d> ReportedCovariances(const Dataset& dataset,
                                          const std::vector<Pose3d>& base_from_platform);

// Eq. (1): world_from_tool = world_from_base * base_from_platform * platform_from_tool.
std::vector<Pose3d> PredictToolPoses(const Machine& machine,
                                     const std::vector<Pose3d>& base_from_platform);

// Where the tool really is in every row of robot_poses, by the model: effects of the robot and its
// mounts and the pose map are in it, effects of the tracker and of the markers are not. InputError
// where the dataset lacks what an effect needs, or legs reach no pose.
std::vector<Pose3d> Predict(const Machine& machine, const Dataset& dataset);

}  // namespace hexcal
