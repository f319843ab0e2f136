// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "measurement/table_input.h"

#include "measurement/dataset.h"

namespace hexcal {

// The mapping under measurement: and its table. tracker_is_static: the base markers need not have
// been seen in every pose then. Without needs_readings the table may be absent (a plan: what is to
// be measured and how well, for a simulation). Without needs_base, markers of the tool alone may be
// listed; W is the tracker's frame then. InputError for fewer than three measured poses in a
// table.
Measurement ReadMeasurement(const YamlNode& node,
                            const RobotPoses& robot_poses,
                            bool tracker_is_static,
                            bool needs_readings,
                            const ReadContext& context,
                            bool needs_base = true);

// The rows of a table of measured poses into measurement.poses. InputError for a pose that
// robot_poses does not list, and for one that stands twice.
void ReadPoseTable(TableReader& table,
                   const RobotPoses& robot_poses,
                   const ReadContext& context,
                   Measurement& measurement);

}  // namespace hexcal
