// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "apps/command.h"

namespace hexcal {

struct CommandLine {
  enum class Action { kRun, kHelp, kVersion };
  Action action = Action::kRun;
  const Command* command = nullptr;  // kHelp: of the whole program without one
  std::vector<std::string> files;
  std::set<std::string_view> given;  // the flags that stand on the command line
};

// Reads COMMAND [FILES] [--flags] and sets the flags. --name=value, --name value, --switch,
// --noswitch; what follows -- is a file. UsageError for everything else: unknown commands and
// flags (with the nearest known one), flags of other commands, bad values, a flag given twice.
// gflags' own flags (--flagfile, --fromenv, ...) are unknown here.
CommandLine ParseCommandLine(const std::vector<std::string>& arguments);

// After the config file: UsageError where a flag that the command needs is missing, or one is given
// that has no effect beside the others (--error without --solver=linearized; in a config file,
// which may serve both solvers, that is no mistake).
void CheckComplete(const CommandLine& line);

}  // namespace hexcal
