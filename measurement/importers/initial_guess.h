// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "measurement/dataset.h"
#include "measurement/importers/recording.h"

namespace hexcal {

// A first guess of base and tool from another program's calibration of one of them; the other
// follows from the first measured pose. stored.is_tool: platform from tool, else base from world
// (where the tracker is the world). InputError where the dataset has no measured pose.
InitialGuess GuessFrom(const StoredTransform& stored, const Dataset& dataset);

}  // namespace hexcal
