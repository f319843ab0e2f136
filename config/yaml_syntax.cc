// SPDX-License-Identifier: BSD-3-Clause
#include "config/yaml_syntax.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "config/utf8.h"

namespace hexcal {
namespace {

constexpr std::string_view kBlanks = " \t\r";

struct Line {
  std::size_t begin = 0;
  std::string_view text;  // without its line end

  std::size_t FirstWord() const {  // offset in the line
    return std::min(text.find_first_not_of(kBlanks), text.size());
  }
  bool Blank() const { return FirstWord() == text.size() || text[FirstWord()] == '#'; }
};

Line LineAt(std::string_view text, std::size_t offset) {
  const std::size_t begin = offset == 0 ? 0 : text.rfind('\n', offset - 1) + 1;  // npos + 1 is 0
  return {begin, text.substr(begin, text.find('\n', begin) - begin)};
}

std::optional<Line> LastLineBefore(std::string_view text, Line line) {
  while (line.begin > 0) {
    line = LineAt(text, line.begin - 1);
    if (!line.Blank()) return line;
  }
  return std::nullopt;
}

bool IsKeyCharacter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
         c == '-';
}

// Offset in the line of the ':' of "key:value", or npos.
std::size_t ColonWithoutSpace(const Line& line) {
  std::size_t at = line.FirstWord();
  const std::size_t first = at;
  while (at < line.text.size() && IsKeyCharacter(line.text[at])) ++at;
  const bool glued = at > first && at + 1 < line.text.size() && line.text[at] == ':' &&
                     kBlanks.find(line.text[at + 1]) == std::string_view::npos;
  return glued ? at : std::string_view::npos;
}

std::optional<YamlSyntaxError> ExplainTab(const Line& line) {
  const std::size_t tab = line.text.find('\t');
  if (tab > line.FirstWord() || tab == std::string_view::npos) return std::nullopt;
  return YamlSyntaxError{line.begin + tab, "a tab used as indentation", "spaces"};
}

YamlSyntaxError ExplainMissingSpace(const Line& line, std::size_t colon) {
  return {
      line.begin + colon,
      fmt::format("no space after the ':' of '{}'", Shorten(line.text.substr(line.FirstWord()))),
      "'key: value'"};
}

// A ':' where no key can stand: one line above forgot its ':' or the space after it, or the value
// itself holds ": ".
YamlSyntaxError ExplainMapValue(std::string_view text, std::size_t offset) {
  const Line line = LineAt(text, offset);
  if (const std::optional<Line> above = LastLineBefore(text, line)) {
    const std::size_t colon = ColonWithoutSpace(*above);
    if (colon != std::string_view::npos) return ExplainMissingSpace(*above, colon);
    const std::size_t word = above->FirstWord();
    if (word >= line.FirstWord() && IsKeyCharacter(above->text[word]) &&
        above->text.substr(word, 2) != "- " && above->text.find(':') == std::string_view::npos)
      return {above->begin + word,
              fmt::format("'{}' without ':'", Shorten(above->text.substr(word))),
              "'key: value'"};
  }
  const std::string_view before = line.text.substr(0, offset - line.begin);
  const std::size_t brace = before.find('{');
  if (brace != std::string_view::npos && brace > 0 && before.find(':') > brace)
    return {line.begin + brace, "a '{' without ':' before it", "'key: {...}'"};
  if (before.find(": ") != std::string_view::npos)
    return {offset, "a second ':' in the line", "quotes around a value that holds ': '"};
  return {offset,
          "a ':' where no key can stand",
          "'key: value' with the same indentation as its neighbours"};
}

YamlSyntaxError ExplainOpenBracket(std::string_view text, std::size_t bracket, std::size_t stop) {
  const char open = text[bracket];
  const char close = open == '[' ? ']' : '}';
  const auto line_of = [&](std::size_t offset) {
    return std::count(text.begin(), text.begin() + static_cast<long>(offset), '\n') + 1;
  };
  return {bracket,
          line_of(stop) == line_of(bracket)
              ? fmt::format("a '{}' that is not followed by a list of items and '{}'", open, close)
              : fmt::format("a '{}' that is not closed before line {}", open, line_of(stop)),
          fmt::format("',' between the items and '{}' after the last", close)};
}

YamlSyntaxError ExplainEndOfBlock(std::string_view text, std::size_t offset) {
  const Line line = LineAt(text, offset);
  if (offset - line.begin <= line.FirstWord())
    return {offset,
            "a line whose indentation fits nothing above it",
            "the same indentation as its neighbours"};
  return {offset,
          fmt::format("'{}' behind a value", Shorten(line.text.substr(offset - line.begin), 20)),
          "the end of the line (a value ends with its closing quote or bracket)"};
}

}  // namespace

YamlSyntaxError ExplainYamlError(std::string_view text,
                                 std::size_t offset,
                                 std::string_view parser_message,
                                 std::size_t open_bracket) {
  offset = std::min(offset, text.size());
  const Line line = LineAt(text, offset);
  const auto says = [&](std::string_view words) {
    return parser_message.find(words) != std::string_view::npos;
  };
  if (const std::optional<YamlSyntaxError> tab = ExplainTab(line)) return *tab;
  if (says("flow not found") && open_bracket != kNoBracket)
    return ExplainOpenBracket(text, open_bracket, offset);
  if (says("illegal flow end"))
    return {offset,
            fmt::format("'{}' without its opening bracket", text.substr(offset, 1)),
            "every '[' closed by ']' and every '{' by '}'"};
  if (says("illegal map value")) return ExplainMapValue(text, offset);
  if (says("illegal block entry"))
    return {
        offset, "a list item '- ' here", "every '- ' on a line of its own, as far to the right"};
  if (says("end of map") || says("end of sequence")) return ExplainEndOfBlock(text, offset);
  if (says("unknown token"))
    return {offset,
            fmt::format("a value that starts with '{}'", text.substr(offset, 1)),
            "such a value in quotes"};
  if (says("escape"))
    return {offset,
            "a backslash that starts no known escape",
            "'\\\\' for a backslash in double quotes, or single quotes"};
  if (says("EOF in scalar"))
    return {offset, "the end of the file within quotes", "a closing quote (is one unpaired?)"};
  if (says("block scalar"))
    return {offset,
            "this behind a '|' or '>'",
            "the end of the line, and the text indented on the lines below"};
  if (says("anchor") || says("alias"))
    return {offset, "an anchor or alias ('&' or '*')", "plain values (repeat the value instead)"};
  return {offset,
          fmt::format("text that is not YAML ({})", parser_message),
          "'key: value' lines, indented by spaces"};
}

bool QuoteIsClosed(std::string_view text, std::size_t offset) {
  const char quote = text[offset];
  for (std::size_t i = offset + 1; i < text.size(); ++i) {
    if (quote == '"' && text[i] == '\\') {
      ++i;
    } else if (text[i] == quote) {
      if (quote == '"' || i + 1 >= text.size() || text[i + 1] != quote) return true;
      ++i;  // '' is a quote character within single quotes
    }
  }
  return false;
}

}  // namespace hexcal
