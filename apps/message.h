// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

namespace hexcal {

// For people, on stderr, one line each; a running progress bar gives way.
void PrintError(std::string_view text);    // "hexcal: text"
void PrintWarning(std::string_view text);  // "hexcal: warning: text"

// Whether the beginning of a message has a colour: on a terminal that knows colours, unless
// NO_COLOR is set and not empty (no-color.org). no_color, term: the values of these variables, or
// null.
bool IsColoured(bool is_terminal, const char* no_color, const char* term);

}  // namespace hexcal
