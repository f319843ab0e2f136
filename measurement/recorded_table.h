// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "config/units.h"
#include "geometry/pose.h"
#include "measurement/dataset.h"

namespace hexcal {

// How a dataset's own table states its robot poses.
struct RecordedColumns {
  std::vector<std::string> names;  // in the table's order
  Units units;
};

// Of a dataset that ReadDataset has accepted.
RecordedColumns ReadRecordedColumns(const std::string& dataset_path);

// The poses as a table of these columns, numbers to the last bit that their unit allows. Leg
// lengths are the rows' own; poses are base_from_platform, one a row. Ends with a newline.
std::string RecordedTable(const RecordedColumns& columns,
                          const RobotPoses& poses,
                          const std::vector<Pose3d>& base_from_platform);

}  // namespace hexcal
