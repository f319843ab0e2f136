// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "measurement/importers/recording.h"

namespace hexcal {

// Poses of one body over time, m.
// TUM: "seconds x y z qx qy qz qw" between blanks, '#' comments; the scalar last.
// Known by its first row: eight numbers, the last four of which are a rotation.
bool IsTum(std::string_view beginning);
Recording ReadTum(const std::string& path, const ImportOptions& options);
// EuRoC: a CSV "nanoseconds, x, y, z, qw, qx, qy, qz, ..." whose first line begins with '#'; the
// scalar first. What follows the pose (velocities, biases) is not used.
Recording ReadEuroc(const std::string& path, const ImportOptions& options);

}  // namespace hexcal
