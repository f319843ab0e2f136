// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "apps/command_line.h"

namespace hexcal {

// Sets the flags that a YAML file names (as keys, without dashes) and the command line does not.
// InputError with file and line for a key that is no flag of the command and for a value that the
// flag does not take.
void ApplyConfigFile(const std::string& path, const CommandLine& line);

}  // namespace hexcal
