// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "measurement/importers/assemble.h"
#include "measurement/importers/recording.h"

namespace hexcal {

// What the flags of hexcal import say. UsageError and InputError.
ImportOptions TrackerOptions();
ImportOptions RobotOptions();
AssembleOptions AssembleOptionsFromFlags();

}  // namespace hexcal
