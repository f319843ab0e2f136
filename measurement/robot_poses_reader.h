// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "measurement/covariates.h"
#include "measurement/table_input.h"

namespace hexcal {

// The mapping under robot_poses: and its table. hexapod: nullptr where the dataset has none; leg
// lengths are refused then.
RobotPoses ReadRobotPoses(const YamlNode& node,
                          const std::vector<CovariateDeclaration>& covariates,
                          const HexapodGeometry* hexapod,
                          const ReadContext& context);

}  // namespace hexcal
