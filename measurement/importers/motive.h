// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "measurement/importers/recording.h"

namespace hexcal {

// OptiTrack Motive's CSV: a line of settings (length units, rotation type), lines Type, Name, ID,
// ..., kinds and axes of the columns, down to the one that begins with "Frame,Time". Markers and
// rigid bodies (global, quaternion x y z w) are read; a marker "A:..." belongs to the body A. Empty
// cells were not seen. Columns of rigid body markers hold where a marker is expected, even when it
// is not seen: they are not used.
Recording ReadMotive(const std::string& path, const ImportOptions& options);

}  // namespace hexcal
