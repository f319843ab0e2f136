// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "geometry/pose.h"
#include "measurement/hexapod_geometry.h"

namespace hexcal {

// Where the platform can go: a box about a pose in its middle, as far as legs allow.
struct Reach {
  Pose3d home;  // base_from_platform
  // Of the position, m, frame B, and of the rotation vector, rad, frame A, both counted from home.
  Vector6d low = Vector6d::Zero(), high = Vector6d::Zero();
  std::optional<HexapodGeometry> hexapod;
  Eigen::Vector2d leg_limits = Eigen::Vector2d::Zero();  // min, max, m; of the hexapod

  double home_determinant = 0.0;  // of the leg Jacobian

  Pose3d At(const Vector6d& from_home) const;
  // Whether the legs are long and short enough, and the pose is well away from singular ones.
  bool Holds(const Pose3d& base_from_platform) const;
};

// With leg limits: as far as they let the platform go from home along each axis, turned by 30
// degrees at most, and everything that the reported poses span. Without: the box that the reported
// poses span, and the legs' lengths in them. hexapod: null where there is none. reported: at least
// one.
Reach ReachOf(const HexapodGeometry* hexapod, const std::vector<Pose3d>& reported);

// Poses that fill the reach evenly, every second one on the edge of the box: where the legs do not
// reach it is moved towards home until they do. Equal seeds give equal poses.
std::vector<Pose3d> MakePosePool(const Reach& reach, int count, std::uint64_t seed);

}  // namespace hexcal
