// SPDX-License-Identifier: BSD-3-Clause
#include "measurement/importers/times.h"

#include <charconv>
#include <cmath>
#include <string>

#include "config/number.h"

namespace hexcal {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;  // ns
constexpr std::int64_t kMostSeconds = kMostNanoseconds / kSecond;

}  // namespace

std::optional<std::int64_t> Nanoseconds(double seconds) {
  if (!(std::abs(seconds) <= static_cast<double>(kMostSeconds))) return std::nullopt;
  return static_cast<std::int64_t>(std::llround(seconds * static_cast<double>(kSecond)));
}

std::optional<std::int64_t> ParseSeconds(std::string_view text) {
  const std::optional<double> value = ParseDouble(text);
  if (!value || !Nanoseconds(*value)) return std::nullopt;
  const std::size_t point = text.find('.');
  if (text.find_first_of("eE") != std::string_view::npos || point == std::string_view::npos)
    return Nanoseconds(*value);
  const bool is_negative = text.front() == '-';
  const std::string_view whole = text.substr(0, point);
  std::string fraction(text.substr(point + 1, 9));
  fraction.resize(9, '0');
  std::int64_t seconds = 0, nanoseconds = 0;
  const std::size_t sign = is_negative || text.front() == '+' ? 1 : 0;
  std::from_chars(whole.data() + sign, whole.data() + whole.size(), seconds);
  std::from_chars(fraction.data(), fraction.data() + fraction.size(), nanoseconds);
  const std::int64_t size = seconds * kSecond + nanoseconds;
  return is_negative ? -size : size;
}

}  // namespace hexcal
