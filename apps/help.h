// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "apps/command.h"

namespace hexcal {

std::string ProgramHelp();                        // hexcal help
std::string CommandHelp(const Command& command);  // hexcal help COMMAND
std::string FlagText(const CommandFlag& flag);    // what it is, its range and default
std::string UsageLine(const Command& command);    // hexcal predict DATASET --model=FILE ... [flags]

std::string FlagForm(const CommandFlag& flag);  // --name=VALUE
std::string_view ExitStatusText();              // a line or more each
// A command to be typed, each line after indent spaces, cut between its words where it is long.
std::string WrapExample(std::string_view line, std::size_t indent);

}  // namespace hexcal
