// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

namespace hexcal {

// For people, on stderr, one line each; a running progress bar gives way.
void PrintError(std::string_view text);    // "hexcal: text"
void PrintWarning(std::string_view text);  // "hexcal: warning: text"

}  // namespace hexcal
