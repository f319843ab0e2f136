// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "measurement/importers/recording.h"

namespace hexcal {

// C3D: the points of a motion capture, binary. Intel byte order, whole numbers or floats; other
// processors are refused. Units and labels are those of the parameters POINT:UNITS (mm, cm or m)
// and POINT:LABELS; a point whose residual is below 0 was not seen. Times are frames over the
// frame rate. Analog channels are skipped. Messages name the byte.
Recording ReadC3d(const std::string& path, const ImportOptions& options);

}  // namespace hexcal
