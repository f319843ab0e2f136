// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "measurement/importers/recording.h"

namespace hexcal {

// A GCS array file of Physik Instrumente (data recorder, PIPython): lines "# KEY = VALUE", names of
// columns, rows. The axes X Y Z (mm) and U V W (degrees) are found by the last word of their
// columns' names, or by options.columns; the pose is Tra(X, Y, Z) with the rotation of
// options.rotation_order (PI: U, V, W about axes that move along, "xyz"). SAMPLE_TIME gives the
// times of the rows, from 0.
Recording ReadPiGcs(const std::string& path, const ImportOptions& options);

}  // namespace hexcal
