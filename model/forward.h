// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "geometry/pose.h"
#include "measurement/hexapod_geometry.h"
#include "model/corrections.h"
#include "model/tracker_reading.h"
#include "model/visit.h"

namespace hexcal {

// The one forward model, exact: corrected legs and joints go through forward kinematics.

// Mounts of a machine: what Forward needs beside the corrections.
struct Mounts {
  Pose3d world_from_base;
  Pose3d platform_from_tool;
};

struct ForwardPose {
  bool reached = true;        // false: forward kinematics found no pose
  Pose3d base_from_platform;  // where the platform really is
  Pose3d world_from_tool;
};

// hexapod: nominal; null: legs and joints cannot be corrected (CHECKed). Corrections that are zero
// leave every pose as it is to the last bit.
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

// The same where the mounts move: columns are right twists of world_from_base, then of
// platform_from_tool (the paper's 12).
Eigen::Matrix<double, 6, 12> ForwardByMounts(const Mounts& mounts,
                                             const Corrections<double>& corrections,
                                             const ForwardPose& at);

}  // namespace hexcal
