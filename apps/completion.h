// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "apps/command.h"

namespace hexcal {

// hexcal completion bash|zsh
Command CompletionCommand();

// Scripts that complete commands, flags, their values and files, from the tables of commands and
// flags.
std::string BashCompletion();
std::string ZshCompletion();

}  // namespace hexcal
