// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "apps/command.h"

namespace hexcal {

std::string ProgramHelp();                        // hexcal help
std::string CommandHelp(const Command& command);  // hexcal help COMMAND
std::string FlagText(const CommandFlag& flag);    // what it is, its range and default
std::string UsageLine(const Command& command);    // hexcal predict DATASET --model=FILE ... [flags]

}  // namespace hexcal
