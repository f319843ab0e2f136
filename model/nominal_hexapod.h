// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "measurement/hexapod_geometry.h"

namespace hexcal {

// A hexapod as it is drawn: the joints of each plate in three pairs on a circle about z, the pairs
// of the platform half way between those of the base. Six numbers and how the frames lie in it.
struct NominalHexapod {
  double base_radius = 1.0, platform_radius = 1.0;  // of the circles, m
  // Half the angle between the two joints of a pair, rad, in (0, pi / 6): each leg leans from one
  // pair to the next.
  double base_half_angle = 0.2, platform_half_angle = 0.2;
  double base_height = -1.0;     // z of the base's circle in frame B, m
  double platform_height = 0.0;  // z of the platform's circle in frame A, m
  double yaw = 0.0;  // of the base's first pair, about z of frame B, rad; at home A is not turned
};

// Legs 1 and 2 from the first pair of the base, 3 and 4 from the second, 5 and 6 from the third.
HexapodGeometry MakeHexapod(const NominalHexapod& nominal);

}  // namespace hexcal
