// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "apps/command_line.h"
#include "config/strict_yaml.h"

namespace hexcal {

// Sets the flags that a YAML file names (as keys, without dashes) and the command line does not.
// InputError with file and line for a key that is no flag of the command and for a value that the
// flag does not take.
void ApplyConfigFile(const std::string& path, const CommandLine& line);

// Sets the flags that a mapping names, these keys being allowed; those that are given already are
// judged only. InputError with file and line for another key and for a value that the flag does not
// take.
void ApplySettings(const YamlNode& settings,
                   std::string_view what,
                   const std::vector<std::string_view>& keys,
                   const std::set<std::string_view>& given = {});

}  // namespace hexcal
