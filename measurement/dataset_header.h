// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "config/strict_yaml.h"

namespace hexcal {

// Refuses a file whose `format:` is not the expected one. To be asked before anything else: a file
// of another version may have other keys.
void CheckFormat(const YamlNode& root, std::string_view expected);

// Letters, digits, '.', '_' and '-' only: the name becomes that of a folder of results.
std::string ReadName(const YamlNode& node);
bool IsFolderName(std::string_view name);

}  // namespace hexcal
