// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace hexcal {

// A syntax error in words that a newcomer can act on.
struct YamlSyntaxError {
  std::size_t offset = 0;  // byte of the text that the message is about
  std::string found;
  std::string expected;
};

inline constexpr std::size_t kNoBracket = std::string_view::npos;

// parser_message and offset: what the YAML parser said, and where it stopped. open_bracket: byte of
// the innermost '[' or '{' not yet closed there, or kNoBracket. The cause is often earlier: a tab,
// a missing space after ':', an unclosed bracket.
YamlSyntaxError ExplainYamlError(std::string_view text,
                                 std::size_t offset,
                                 std::string_view parser_message,
                                 std::size_t open_bracket);

// False where the quote character at offset has no partner. (The parser takes the rest of the file
// as the text then, and complains of nothing.)
bool QuoteIsClosed(std::string_view text, std::size_t offset);

}  // namespace hexcal
