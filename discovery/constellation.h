// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "geometry/pose.h"
#include "measurement/dataset.h"
#include "measurement/tool_pose.h"
#include "model/corrections.h"

namespace hexcal {

// The markers of one rigid body as seen in one pose, and what a rigid fit leaves of them. Columns
// of equal index belong together.
struct SeenBody {
  std::vector<int> markers;       // in the body
  Eigen::Matrix3Xd p_in_tracker;  // mean readings, m
  Eigen::Matrix3Xd p_in_body;     // m
  Eigen::Matrix3Xd sigma;         // of the mean readings, tracker's axes, m
  Pose3d tracker_from_body;
  Matrix6d covariance = Matrix6d::Zero();  // right twist
  // 3n x (3n - 6): what of the whitened readings no rigid motion explains.
  Eigen::MatrixXd shape_basis;

  // Right twist of tracker_from_body that displaced readings (3 x n, m) make.
  Vector6d TwistOf(const Eigen::Matrix3Xd& displacement) const;
  // Shape rows of displaced readings, in units of sigma.
  Eigen::VectorXd ShapeOf(const Eigen::Matrix3Xd& displacement) const;
  // Shape rows of the readings themselves.
  Eigen::VectorXd Misfit() const;
};

// One measured pose. Kind poses has no bodies; under a static tracker the base body, which is one
// for all poses, is not among them.
struct SeenPose {
  int row = 0;  // of robot_poses
  Pose3d world_from_tool;
  Matrix6d covariance = Matrix6d::Zero();  // of the stated noise, or of the unit sigma
  std::array<SeenBody, 2> bodies;          // markers empty: not there

  bool HasShape() const { return !bodies[0].markers.empty() || !bodies[1].markers.empty(); }
  // Right twist of the measured world_from_tool that twists of the bodies (base, tool) make.
  Vector6d MeasuredTwist(const Vector6d& base, const Vector6d& tool) const;
};

// What was seen of all measured poses, rid of the given tracker and marker corrections
// (corrections[row]; empty: none).
std::vector<SeenPose> SeePoses(const Dataset& dataset,
                               const ToolPoses& tool_poses,
                               const std::vector<Corrections<double>>& corrections);

}  // namespace hexcal
