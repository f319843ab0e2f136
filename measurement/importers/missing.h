// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

namespace hexcal {

// How other programs write "not seen", all in one place: NDI's bad float -3.697314E28, which is
// known by its size since it is rounded in many ways, and what is not a number.
bool IsMissing(double value);

// An empty cell, or a word: nan, missing, disabled, in any case.
bool IsMissing(std::string_view cell);

}  // namespace hexcal
