// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geometry/pose.h"
#include "measurement/dataset.h"
#include "residuals/pose_error.h"

namespace hexcal {

// One pose of the robot and where the tracker saw the tool then.
struct Observation {
  std::string label;
  Pose3d base_from_platform;
  Pose3d world_from_tool;
  Matrix6d tool_covariance =
      Matrix6d::Zero();  // of the measurement, frame T; zero where it is not known
  Matrix6d robot_covariance =
      Matrix6d::Zero();  // of the reported pose, frame A; zero where the robot is taken as exact
};

// All that an estimator needs, and nothing of where it came from.
struct Observations {
  std::vector<Observation> items;
  bool tool_noise_is_known = false;
  bool has_robot_noise = false;
  // A tracker that stood still: its common pose and the covariance of that, which world_from_base
  // inherits.
  std::optional<Pose3d> tracker_from_world;
  Matrix6d tracker_from_world_covariance = Matrix6d::Zero();
  std::vector<std::string> warnings;
};

// InputError where the dataset cannot be used (legs that reach no pose, too few poses with a tool
// frame).
Observations MakeObservations(const Dataset& dataset);

// Unknown levels of an isotropic tool noise: 1-sigma of one coordinate, m, and of one angle, rad.
struct NoiseLevels {
  double position = 0.0;
  double orientation = 0.0;
};

// C = C_tool + A C_robot A', A = InverseAdjoint(platform_from_tool): the covariance of the pose
// error in frame T. C_tool is the known one, or that of levels.
Matrix6d ErrorCovariance(const Observation& observation,
                         const Observations& observations,
                         const Pose3d& platform_from_tool,
                         const NoiseLevels& levels);

// Whether ErrorCovariance is the same for all.
bool HasCommonCovariance(const Observations& observations);

// The pose error of an observation, not whitened, and its exact derivative by the 12 parameters.
struct LinearisedError {
  Vector6d error;
  Matrix6x12d jacobian;
};
LinearisedError Linearise(const Observation& observation, const BaseAndTool& mounts);

// How far the poses spread, m and rad: weights of position against orientation that need no fit.
// Never zero.
NoiseLevels Spread(const std::vector<Observation>& observations);

// The rounding of the data, m and rad: nothing below it means anything.
NoiseLevels Rounding(const std::vector<Observation>& observations);

}  // namespace hexcal
