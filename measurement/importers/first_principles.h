// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "measurement/importers/recording.h"

namespace hexcal {

// NDI First Principles, 3D data as text: lines "Number of frames: N", "Frequency: Hz", "Units: mm",
// an empty one, then "Frame", "NAME x", "NAME y", "NAME z" for each marker, between tabs or commas.
// Empty cells were not seen. Times are frames over the frequency, from 0. 6D exports vary in their
// columns and go by a column map.
Recording ReadFirstPrinciples(const std::string& path, const ImportOptions& options);

}  // namespace hexcal
