// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>

#include "geometry/pose.h"
#include "measurement/hexapod_geometry.h"

namespace hexcal {

using LegLengths = Eigen::Matrix<double, kNumLegs, 1>;

// Inverse kinematics: joint centre to joint centre, m.
LegLengths InverseKinematics(const HexapodGeometry& hexapod, const Pose3d& base_from_platform);

// d(leg lengths) / d(right perturbation of base_from_platform), 6 x 6, [m/m, m/rad]: row i is
// [u', (a x u)'] with u the leg's unit vector in the platform and a its joint there.
Matrix6d LegJacobian(const HexapodGeometry& hexapod, const Pose3d& base_from_platform);

// Where forward kinematics starts when nobody says better: home, else the platform held level over
// the centroid of the base joints, on the side of +z of frame B, at the height at which the mean
// squared leg length is right. Legs too short for any height: a tenth of their mean. Level means
// with parallel frames, or, where these disagree, with each joint as near above its partner as can
// be.
Pose3d NeutralPose(const HexapodGeometry& hexapod, const LegLengths& lengths);

struct ForwardKinematicsResult {
  bool converged = false;
  Pose3d base_from_platform;
  double largest_misfit = 0.0;  // m, of the six lengths
  int iterations = 0;
  std::string message;  // why it did not converge
};

// Levenberg-Marquardt on the six lengths, from start. Converged: every length is met to 1e-12 of
// the largest leg. The platform stays on start's side of the base joints' plane; of the poses there
// the one is sought that start could move to without passing a singular pose, else any.
ForwardKinematicsResult ForwardKinematics(const HexapodGeometry& hexapod,
                                          const LegLengths& lengths,
                                          const Pose3d& start);

}  // namespace hexcal
