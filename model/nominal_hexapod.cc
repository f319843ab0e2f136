// SPDX-License-Identifier: BSD-3-Clause
#include "model/nominal_hexapod.h"

#include <cmath>

namespace hexcal {

HexapodGeometry MakeHexapod(const NominalHexapod& nominal) {
  const auto on_circle = [](double radius, double angle, double height) {
    return Eigen::Vector3d(radius * std::cos(angle), radius * std::sin(angle), height);
  };
  HexapodGeometry hexapod;
  for (int leg = 0; leg < kNumLegs; ++leg) {
    const double pair = nominal.yaw + (leg / 2) * 2.0 * M_PI / 3.0;
    const double side = leg % 2 == 0 ? -1.0 : 1.0;
    hexapod.base_joints_in_base.col(leg) =
        on_circle(nominal.base_radius, pair + side * nominal.base_half_angle, nominal.base_height);
    hexapod.platform_joints_in_platform.col(leg) =
        on_circle(nominal.platform_radius,
                  pair + side * (M_PI / 3.0 - nominal.platform_half_angle),
                  nominal.platform_height);
  }
  return hexapod;
}

}  // namespace hexcal
