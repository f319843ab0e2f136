// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>

#include "geometry/pose.h"
#include "measurement/hexapod_geometry.h"
#include "model/corrections.h"
#include "model/visit.h"

namespace hexcal {

// The one forward model, exact: corrected legs and joints go through forward kinematics.

// Mounts of a machine, by pointer: what Forward needs beside the corrections.
struct Mounts {
  Pose3d world_from_base;
  Pose3d platform_from_tool;
};

struct ForwardPose {
  bool reached = true;        // false: forward kinematics found no pose
  Pose3d base_from_platform;  // where the platform really is
  Pose3d world_from_tool;
};

// hexapod: nominal; null: legs and joints cannot be corrected (CHECKed).
ForwardPose Forward(const Mounts& mounts,
                    const HexapodGeometry* hexapod,
                    const Visit& visit,
                    const Corrections<double>& corrections);

// d(world_from_tool), right twist [m, rad] in frame T, where the corrections move by `motion` from
// where `at` was computed with `corrections`. Exact to first order; checked against differences.
Vector6d ForwardDerivative(const Mounts& mounts,
                           const HexapodGeometry* hexapod,
                           const Visit& visit,
                           const Corrections<double>& corrections,
                           const ForwardPose& at,
                           const Corrections<double>& motion);

// What the tracker reads of a point that is at p in its frame, m.
Eigen::Vector3d TrackerReading(const Corrections<double>& corrections, const Eigen::Vector3d& p);
// Its derivative by p (3 x 3).
Eigen::Matrix3d TrackerReadingByPoint(const Corrections<double>& corrections,
                                      const Eigen::Vector3d& p);
// Its change where the corrections move by `motion`.
Eigen::Vector3d TrackerReadingBy(const Corrections<double>& corrections,
                                 const Eigen::Vector3d& p,
                                 const Corrections<double>& motion);

// Kind poses has no marker to displace: a tracker that scales (tracker_scale) and stands
// tracker_twist away moves the measured pose: world = the tracker's frame.
Pose3d TrackerPoseReading(const Corrections<double>& corrections, const Pose3d& world_from_tool);

}  // namespace hexcal
