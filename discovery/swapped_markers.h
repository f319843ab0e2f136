// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "discovery/faults.h"

namespace hexcal {

// Pairs of markers that carry each other's name in all poses, one after another: with the names put
// right both bodies fit their known shapes far better. Empty where none does, and where there are
// no readings or no known shapes. A swap that a turn of its body undoes is not seen; it does no
// harm beyond that turn.
std::vector<FaultFound> FindSwappedMarkers(const Dataset& dataset);

}  // namespace hexcal
