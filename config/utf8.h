// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "config/input_error.h"

namespace hexcal {

inline constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

// InputError with line and column for the first byte that is no text: not UTF-8, a control
// character other than a tab, a line end other than LF or CRLF. start is the place of the first
// character of text.
void RefuseBadText(std::string_view text, const Location& start);

// Characters, not bytes, as an editor counts columns. text is UTF-8.
int CountCharacters(std::string_view text);

// What a terminal may obey instead of showing: 0 to 0x1F, 0x7F and U+0080 to U+009F (ISO 6429).
bool HasControls(std::string_view text);

// text with replacement for each of them.
std::string WithoutControls(std::string_view text, char replacement);

// At most max_characters of text with control characters shown as '?' and "..." where it was cut:
// what may stand in a message.
std::string Shorten(std::string_view text, int max_characters = 60);

}  // namespace hexcal
