// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace hexcal {

// Times are whole nanoseconds. None is further from zero than this (95 years), so that they can be
// added and subtracted.
inline constexpr std::int64_t kMostNanoseconds = 3'000'000'000'000'000'000;

// Of seconds; nothing where that is too far from zero or not a number.
std::optional<std::int64_t> Nanoseconds(double seconds);

// Seconds as written, to the nanosecond: 1778067471.318767388 does not fit a double. Nothing where
// text is no such number or too far from zero.
std::optional<std::int64_t> ParseSeconds(std::string_view text);

}  // namespace hexcal
