// SPDX-License-Identifier: BSD-3-Clause
#include "config/utf8.h"

#include <fmt/format.h>

#include <algorithm>

namespace hexcal {
namespace {

bool IsContinuation(char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; }

// Bytes of the character at the start of text, 0 if it is not UTF-8 (overlong forms, surrogates
// and values beyond U+10FFFF are not).
std::size_t CharacterBytes(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char lead = byte(0);
  const std::size_t size = lead < 0x80                   ? 1
                           : lead >= 0xC2 && lead < 0xE0 ? 2
                           : lead >= 0xE0 && lead < 0xF0 ? 3
                           : lead >= 0xF0 && lead < 0xF5 ? 4
                                                         : 0;
  if (size == 0 || text.size() < size) return 0;
  for (std::size_t i = 1; i < size; ++i)
    if (!IsContinuation(text[i])) return 0;
  if (lead == 0xE0 && byte(1) < 0xA0) return 0;
  if (lead == 0xED && byte(1) > 0x9F) return 0;
  if (lead == 0xF0 && byte(1) < 0x90) return 0;
  if (lead == 0xF4 && byte(1) > 0x8F) return 0;
  return size;
}

// Bytes of the control character at the start of text, 0 if there is none.
std::size_t ControlBytes(std::string_view text) {
  const auto c = static_cast<unsigned char>(text[0]);
  if (c < 0x20 || c == 0x7F) return 1;
  const bool is_of_two = c == 0xC2 && text.size() > 1 && IsContinuation(text[1]);
  return is_of_two && static_cast<unsigned char>(text[1]) < 0xA0 ? 2 : 0;
}

std::size_t FindBadByte(std::string_view text) {
  std::size_t i = 0;
  while (i < text.size()) {
    const unsigned char c = static_cast<unsigned char>(text[i]);
    if ((c >= 0x20 && c < 0x80) || c == '\n' || c == '\t') {
      ++i;
      continue;
    }
    const bool line_end = c == '\r' && i + 1 < text.size() && text[i + 1] == '\n';
    const std::size_t size = c < 0x20 ? (line_end ? 1 : 0) : CharacterBytes(text.substr(i));
    if (size == 0) return i;
    i += size;
  }
  return std::string_view::npos;
}

}  // namespace

int CountCharacters(std::string_view text) {
  return static_cast<int>(
      std::count_if(text.begin(), text.end(), [](char c) { return !IsContinuation(c); }));
}

bool HasControls(std::string_view text) {
  for (std::size_t i = 0; i < text.size(); ++i)
    if (ControlBytes(text.substr(i)) > 0) return true;
  return false;
}

std::string WithoutControls(std::string_view text, char replacement) {
  std::string plain;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t size = ControlBytes(text.substr(i));
    plain += size > 0 ? replacement : text[i];
    i += size > 0 ? size : 1;
  }
  return plain;
}

std::string Shorten(std::string_view text, int max_characters) {
  std::size_t end = 0;
  for (int count = 0; end < text.size(); ++end)
    if (!IsContinuation(text[end]) && ++count > max_characters) break;
  return WithoutControls(text.substr(0, end), '?') + (end < text.size() ? "..." : "");
}

void RefuseBadText(std::string_view text, const Location& start) {
  const std::size_t at = FindBadByte(text);
  if (at == std::string_view::npos) return;
  const std::string_view before = text.substr(0, at);
  const std::size_t line_start = before.rfind('\n') + 1;  // npos + 1 is 0
  Location where = start;
  const auto lines = static_cast<int>(std::count(before.begin(), before.end(), '\n'));
  where.line += lines;
  where.column = (lines == 0 ? start.column : 1) + CountCharacters(before.substr(line_start));

  const auto bad = static_cast<unsigned char>(text[at]);
  const std::string_view pair = text.substr(at, 2);
  if (pair == "\xFF\xFE" || pair == "\xFE\xFF")
    throw InputError(where, "UTF-16 text", "UTF-8 text (save the file as UTF-8)");
  if (bad == 0)
    throw InputError(where, "a NUL byte", "text in UTF-8 (is it UTF-16, or not a text file?)");
  if (bad == '\r')
    throw InputError(where, "a carriage return inside a line", "lines that end in LF or CRLF");
  if (bad < 0x20)
    throw InputError(where, fmt::format("the control character 0x{:02X}", bad), "plain text");
  throw InputError(where,
                   fmt::format("the byte 0x{:02X}, which is not UTF-8", bad),
                   "UTF-8 text (save the file as UTF-8, not as Latin-1 or Windows-1252)");
}

}  // namespace hexcal
