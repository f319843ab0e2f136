// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "geometry/pose.h"
#include "measurement/hexapod_geometry.h"

namespace hexcal {

// d(leg lengths) / d(right perturbation of the tool), 6 x 6, [m/m, m/rad]: by how much each leg
// would have to be longer to explain a pose error in frame T.
Matrix6d LegsByError(const HexapodGeometry& hexapod,
                     const Pose3d& base_from_platform,
                     const Pose3d& platform_from_tool);

}  // namespace hexcal
