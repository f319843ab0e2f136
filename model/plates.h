// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "geometry/pose.h"
#include "measurement/hexapod_geometry.h"

namespace hexcal {

// The two nominal plates of a hexapod, as effects on joints see them: base in frame B, platform in
// frame A, a column a leg.
struct Plates {
  Matrix36d base_joints, platform_joints;  // m
  // From the centroid of a plate's joints through each joint, in the plane nearest to them; unit
  // vectors, zero for a joint on the centroid.
  Matrix36d base_radial, platform_radial;
  Matrix36d base_axes, platform_axes;  // first axes of the universal joints; default: radial
};
Plates PlatesOf(const HexapodGeometry& hexapod);

// Unit vectors from base joint to platform joint, frame B.
Matrix36d LegsInBase(const Plates& plates, const Pose3d& base_from_platform);

// Turn about each leg (right-hand about base to platform) from the first axis of its lower joint to
// that of its upper joint, both projected along the leg, rad in [-pi, pi].
Vector6d LegRoll(const Plates& plates, const Pose3d& base_from_platform);

}  // namespace hexcal
