// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "config/nearest_word.h"
#include "config/number.h"
#include "config/strict_yaml.h"
#include "config/utf8.h"

namespace hexcal {
namespace {

[[noreturn]] void Refuse(const YamlNode& node,
                         std::string_view expected,
                         std::string_view hint = "") {
  throw InputError(node.where, Describe(node), fmt::format("{}{}", expected, hint));
}

std::string_view QuoteHint(const YamlNode& node, bool parses) {
  return node.quoted && parses ? " (without quotes)" : "";
}

// YAML takes "key:value" without the space, and "key {a: b" without its ':', as one word.
std::string_view ColonHint(std::string_view word) {
  if (word.find_first_of("[{") != std::string_view::npos && word.find_first_of("[{") > 0)
    return " (is a ':' missing before the bracket?)";
  const std::size_t colon = word.find(':');
  const bool glued = colon != std::string_view::npos && colon > 0;
  return glued ? " (is a space missing after ':'?)" : "";
}

std::string Count(std::size_t count, std::string_view what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

}  // namespace

std::string Describe(const YamlNode& node) {
  switch (node.kind) {
    case YamlNode::Kind::kNull:
      return "nothing";
    case YamlNode::Kind::kSequence:
      return node.items.empty() ? "an empty list" : fmt::format("a list of {}", node.items.size());
    case YamlNode::Kind::kMap:
      return node.entries.empty() ? "an empty mapping"
                                  : "a mapping of " + Count(node.entries.size(), "key");
    case YamlNode::Kind::kScalar:
      break;
  }
  const std::optional<double> number = ParseDouble(node.scalar);
  if (!node.quoted && number && std::isfinite(*number))
    return fmt::format("the number {}", Shorten(node.scalar));
  return fmt::format("the text '{}'", Shorten(node.scalar));
}

std::string ReadText(const YamlNode& node, std::string_view expected) {
  if (node.kind != YamlNode::Kind::kScalar) Refuse(node, expected);
  return node.scalar;
}

double ReadNumber(const YamlNode& node, std::string_view expected) {
  if (node.kind != YamlNode::Kind::kScalar) Refuse(node, expected);
  const std::optional<double> value = ParseDouble(node.scalar);
  if (node.quoted) Refuse(node, expected, QuoteHint(node, value.has_value()));
  if (!value || !std::isfinite(*value)) Refuse(node, expected, NumberHint(node.scalar));
  return *value;
}

long ReadInteger(const YamlNode& node, std::string_view expected) {
  if (node.kind != YamlNode::Kind::kScalar) Refuse(node, expected);
  const std::optional<long> value = ParseInteger(node.scalar);
  if (node.quoted || !value) Refuse(node, expected, QuoteHint(node, value.has_value()));
  return *value;
}

bool ReadBool(const YamlNode& node, std::string_view expected) {
  const bool is_true = node.scalar == "true", is_false = node.scalar == "false";
  if (node.kind != YamlNode::Kind::kScalar || node.quoted || !(is_true || is_false))
    Refuse(node, expected, QuoteHint(node, is_true || is_false));
  return is_true;
}

const std::vector<YamlNode>& ReadSequence(const YamlNode& node, std::string_view expected) {
  if (node.kind != YamlNode::Kind::kSequence) Refuse(node, expected);
  return node.items;
}

std::vector<double> ReadNumbers(const YamlNode& node, std::size_t size, std::string_view expected) {
  if (node.kind != YamlNode::Kind::kSequence || node.items.size() != size) Refuse(node, expected);
  std::vector<double> numbers;
  numbers.reserve(size);
  for (const YamlNode& item : node.items)
    numbers.push_back(ReadNumber(item, fmt::format("a number in {}", expected)));
  return numbers;
}

MapReader::MapReader(const YamlNode& node,
                     std::string_view what,
                     const std::vector<std::string_view>& known)
    : node_(&node), what_(what) {
  if (node.kind != YamlNode::Kind::kMap)
    Refuse(node,
           fmt::format("{} as a mapping of 'key: value'", what),
           node.quoted ? "" : ColonHint(node.scalar));
  for (const auto& [key, value] : node.entries) {
    if (std::find(known.begin(), known.end(), key.scalar) != known.end()) continue;
    std::string hint(ColonHint(key.scalar));
    if (hint.empty()) hint = DidYouMean(key.scalar, known);
    throw InputError(
        key.where,
        fmt::format("the unknown key '{}' in {}", Shorten(key.scalar), what),
        fmt::format(
            "{}{}{}", known.size() == 1 ? "only " : "one of ", fmt::join(known, ", "), hint));
  }
}

const YamlNode* MapReader::Optional(std::string_view key) const {
  for (const auto& [name, value] : node_->entries)
    if (name.scalar == key) return &value;
  return nullptr;
}

const YamlNode& MapReader::Required(std::string_view key) const {
  if (const YamlNode* value = Optional(key)) return *value;
  throw InputError(node_->where,
                   fmt::format("no key '{}' in {}", key, what_),
                   fmt::format("'{}: ...', which is required", key));
}

}  // namespace hexcal
