// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "measurement/table_input.h"

#include "measurement/dataset.h"

namespace hexcal {

// The mapping under measurement: and its table. tracker_is_static: the base markers need not have
// been seen in every pose then. Without needs_readings the table may be absent (a plan: what is to
// be measured and how well, for a simulation). InputError for fewer than three measured poses in a
// table.
Measurement ReadMeasurement(const YamlNode& node,
                            const RobotPoses& robot_poses,
                            bool tracker_is_static,
                            bool needs_readings,
                            const ReadContext& context);

}  // namespace hexcal
