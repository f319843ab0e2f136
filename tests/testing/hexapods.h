// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "measurement/hexapod_geometry.h"
#include "testing/random.h"

namespace hexcal::testing {

// A desk-top hexapod, joints in flat plates, about 0.21 m high at the centre of its travel.
inline HexapodGeometry SmallHexapod() {
  HexapodGeometry hexapod;
  hexapod.base_joints_in_base <<  //
      0.18418575,
      -0.0474848898, -0.13670086, -0.13670086, -0.0474848898, 0.18418575,                 //
      0.0515088644, 0.185263971, 0.133755106, -0.133755106, -0.185263971, -0.0515088644,  //
      0, 0, 0, 0, 0, 0;
  hexapod.platform_joints_in_platform <<  //
      0.0572577331,
      0.0216535082, -0.0789112413, -0.0789112413, 0.0216535082, 0.0572577331,                 //
      0.0580610852, 0.0786171941, 0.0205561089, -0.0205561089, -0.0786171941, -0.0580610852,  //
      0, 0, 0, 0, 0, 0;
  return hexapod;
}
inline constexpr double kSmallHeight = 0.21;  // m

// A larger one, base radius 0.4 m, with joints out of plane and the platform's origin above them.
inline HexapodGeometry LargeHexapod() {
  HexapodGeometry hexapod;
  for (int i = 0; i < kNumLegs; ++i) {
    const double third = 2.0 * M_PI / 3.0 * (i / 2), sign = i % 2 == 0 ? -1.0 : 1.0;
    const double b = third + sign * 0.15, a = third + sign * 0.85;
    hexapod.base_joints_in_base.col(i) << 0.4 * std::cos(b), 0.4 * std::sin(b), 0.01 * i;
    hexapod.platform_joints_in_platform.col(i) << 0.22 * std::cos(a), 0.22 * std::sin(a), -0.02;
  }
  return hexapod;
}
inline constexpr double kLargeHeight = 0.5;  // m

// Tilted and turned by up to max_turn rad about any axis, moved by up to half the height along
// each axis of the base.
template <typename Rng>
Pose3d RandomWorkspacePose(Rng& rng, double height, double max_turn) {
  const Eigen::Vector3d axis = Normal(rng, 3).normalized();
  const Eigen::Vector3d turn = axis * Uniform(rng, 0.0, max_turn);
  return {Eigen::Vector3d(0, 0, height) + UniformVector(rng, 0.5 * height), Exp(turn)};
}

}  // namespace hexcal::testing
