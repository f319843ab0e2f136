// SPDX-License-Identifier: BSD-3-Clause
#include "config/input_error.h"

#include <fmt/format.h>

#include "config/utf8.h"

namespace hexcal {
namespace {

// Of a hostile file: no tab, line break or escape sequence reaches the terminal or a log.
std::string OnOneLine(const std::string& text) { return WithoutControls(text, ' '); }

}  // namespace

std::string Location::ToString() const {
  std::string text = file ? *file : std::string("input");
  if (line > 0) text += fmt::format(":{}", line);
  if (line > 0 && column > 0) text += fmt::format(":{}", column);
  return text;
}

Location FileLocation(std::string file) {
  return {std::make_shared<const std::string>(std::move(file)), 0, 0};
}

InputError::InputError(const Location& where, std::string_view found, std::string_view expected)
    : std::runtime_error(
          OnOneLine(fmt::format("{}: found {}, expected {}", where.ToString(), found, expected))) {}

InputError::InputError(const Location& where, std::string_view message)
    : std::runtime_error(OnOneLine(fmt::format("{}: {}", where.ToString(), message))) {}

}  // namespace hexcal
