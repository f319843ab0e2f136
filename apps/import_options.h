// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "measurement/importers/assemble.h"
#include "measurement/importers/recording.h"

namespace hexcal {

// What the flags of hexcal import say. UsageError and InputError.
ImportOptions TrackerOptions();
ImportOptions RobotOptions();
AssembleOptions AssembleOptionsFromFlags();

// The last part of the path, other characters than letters, digits, '.', '_' and '-' being '-': a
// name for a dataset.
std::string NameOfFolder(const std::string& out);

}  // namespace hexcal
