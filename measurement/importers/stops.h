// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "measurement/importers/recording.h"

namespace hexcal {

// A robot's log over time as its stops: the stretches of at least `shortest` s in which all poses
// lie within 10 um and 50 urad of the first. One row a stop: its middle pose and time, its begin
// and end in Recording::spans. InputError where the log has no times, times that do not rise, or no
// stop.
Recording FindStops(const Recording& robot, double shortest);

}  // namespace hexcal
