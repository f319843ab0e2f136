// SPDX-License-Identifier: BSD-3-Clause
#include "config/number.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

namespace hexcal {
namespace {

bool IsDigit(char c) { return c >= '0' && c <= '9'; }

// from_chars knows no leading '+'.
std::string_view DropPlus(std::string_view text) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-' && text[1] != '+') text.remove_prefix(1);
  return text;
}

// from_chars says "out of range" for numbers too large and too small alike. The decimal exponent of
// the first digit that is not 0 tells them apart.
double OutOfRangeValue(std::string_view text) {
  const bool negative = text[0] == '-';
  const std::size_t e = text.find_first_of("eE");
  const std::string_view digits = text.substr(negative ? 1 : 0, e - (negative ? 1 : 0));
  const std::size_t point = std::min(digits.find('.'), digits.size());
  const std::size_t first = digits.find_first_of("123456789");
  if (first == std::string_view::npos) return negative ? -0.0 : 0.0;
  double magnitude = static_cast<double>(point) - static_cast<double>(first);
  if (e != std::string_view::npos) {
    std::string_view exponent = DropPlus(text.substr(e + 1));
    long value = 0;
    const auto [end, error] =
        std::from_chars(exponent.data(), exponent.data() + exponent.size(), value);
    static_cast<void>(end);
    if (error == std::errc::result_out_of_range)
      value = exponent[0] == '-' ? std::numeric_limits<long>::min() / 2
                                 : std::numeric_limits<long>::max() / 2;
    magnitude += static_cast<double>(value);
  }
  const double size = magnitude > 0 ? std::numeric_limits<double>::infinity() : 0.0;
  return negative ? -size : size;
}

bool HasDigitsAround(std::string_view text, char separator) {
  const std::size_t at = text.find(separator);
  return at != std::string_view::npos && at > 0 && at + 1 < text.size() && IsDigit(text[at - 1]) &&
         IsDigit(text[at + 1]);
}

}  // namespace

std::optional<double> ParseDouble(std::string_view text) {
  const std::string_view number = DropPlus(text);
  double value = 0;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), value);
  if (error == std::errc::invalid_argument || end != number.data() + number.size())
    return std::nullopt;
  if (error == std::errc::result_out_of_range) return OutOfRangeValue(number);
  return value;
}

std::optional<long> ParseInteger(std::string_view text) {
  const std::string_view number = DropPlus(text);
  long value = 0;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), value);
  if (error != std::errc() || end != number.data() + number.size()) return std::nullopt;
  return value;
}

std::string NumberHint(std::string_view text) {
  if (const std::optional<double> value = ParseDouble(text))
    return std::isfinite(*value) ? "" : " (finite: nan, inf and too large numbers cannot be used)";
  if (HasDigitsAround(text, ',')) return " (the decimal point is '.', not ',')";
  if (HasDigitsAround(text, '_') || HasDigitsAround(text, '\''))
    return " (without separators between the digits)";
  if (text.size() > 2 && text[0] == '0' && (text[1] == 'x' || text[1] == 'X'))
    return " (in decimal, not hexadecimal)";
  if (text.substr(0, 3) == "\xE2\x88\x92" || text.substr(0, 3) == "\xE2\x80\x93")
    return " (the minus sign is a plain '-')";
  const std::string_view word = text.substr(std::min(text.find_first_not_of("+-."), text.size()));
  if (ParseDouble(word) && !std::isfinite(*ParseDouble(word)))
    return " (finite: nan and inf cannot be used)";
  if (!text.empty() && IsDigit(text.front()) && text.find(' ') != std::string_view::npos)
    return " (one number, without a unit or a second number behind it)";
  return "";
}

}  // namespace hexcal
