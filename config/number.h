// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace hexcal {

// Numbers in text, the same under every locale (std::from_chars). The whole of text must be the
// number: an optional sign, digits, '.', exponent. Not a number: nullopt. The value may be inf or
// nan ("inf", "nan" are read, 1e999 is inf, 1e-999 is 0): callers that want it finite must ask.
std::optional<double> ParseDouble(std::string_view text);
std::optional<long> ParseInteger(std::string_view text);

// What is probably wrong with a text that should be a finite number, for the end of a message:
// " (the decimal point is '.', not ',')". Empty when nothing is to be said.
std::string NumberHint(std::string_view text);

}  // namespace hexcal
