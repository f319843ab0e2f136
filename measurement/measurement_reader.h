// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "measurement/table_input.h"

#include "measurement/dataset.h"

namespace hexcal {

// The mapping under measurement: and its table. tracker_is_static: the base markers need not have
// been seen in every pose then. InputError for fewer than three measured poses.
Measurement ReadMeasurement(const YamlNode& node,
                            const RobotPoses& robot_poses,
                            bool tracker_is_static,
                            const ReadContext& context);

}  // namespace hexcal
