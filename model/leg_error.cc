// SPDX-License-Identifier: BSD-3-Clause
#include "model/leg_error.h"

#include "model/hexapod.h"

namespace hexcal {

Matrix6d LegsByError(const HexapodGeometry& hexapod,
                     const Pose3d& base_from_platform,
                     const Pose3d& platform_from_tool) {
  return LegJacobian(hexapod, base_from_platform) * InverseAdjoint(platform_from_tool.Inverse());
}

}  // namespace hexcal
