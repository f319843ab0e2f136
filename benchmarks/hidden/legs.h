// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "hidden/motion.h"

namespace hexcal::hidden {

using Joints = Eigen::Matrix<double, 3, 6>;

// A hexapod; column i is leg i+1, m. Axes: the first axis of each universal joint, unit vectors.
struct Hexapod {
  Joints base, platform;            // frames B and A
  Joints base_axes, platform_axes;  // likewise
};

// Unit vectors from the centroid of the plate to its joints, in the plate: where a radius grows to,
// and the default first axes.
Joints RadialAxes(const Joints& joints);

// Joint centre to joint centre, m.
Six LegLengths(const Joints& base, const Joints& platform, const Motion& base_from_platform);
// Unit vectors in B from the base joint to the platform joint.
Joints LegDirections(const Joints& base, const Joints& platform, const Motion& base_from_platform);

// Moves *base_from_platform until its legs have these lengths, by Newton with differences on the
// six loops. False: it did not get below 1e-12 m.
bool CloseLoop(const Joints& base,
               const Joints& platform,
               const Six& lengths,
               Motion* base_from_platform);

// How far each leg's upper fork is turned against its lower one about the leg, rad. The lower
// fork's axis is perpendicular to the leg and to the base joint's first axis, the upper one's to
// the leg and to the platform joint's first axis. Counted from the legs at home.
Six ForkRoll(const Hexapod& hexapod, const Motion& home, const Motion& base_from_platform);

// Axial forces, N, tension positive, that hold a mass (kg) whose centre is at `centre` in frame A
// against gravity (unit vector in B).
Six LegForces(const Hexapod& hexapod,
              const Motion& base_from_platform,
              double mass,
              const Eigen::Vector3d& centre,
              const Eigen::Vector3d& gravity);

}  // namespace hexcal::hidden
