// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "config/table.h"
#include "measurement/labels.h"

namespace hexcal {

// Reads the rows pose, body, marker, x, y, z and optionally frame into measurement.readings and
// .frame_labels; measurement.bodies must be there. Empty coordinates: unseen, no reading.
// InputError for a pose, body or marker that is not known, for coordinates that are partly empty,
// and for a second row of one marker in one frame of one pose.
void ReadMarkerTable(TableReader& table,
                     const RobotPoses& robot_poses,
                     const Units& units,
                     Measurement& measurement);

}  // namespace hexcal
