// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "config/input_error.h"

namespace hexcal {

// A YAML document as plain data in which every node knows its line and column. Refused with an
// InputError while it is read: anchors, aliases, tags, a second document, duplicate keys, keys that
// are not plain text, nesting deeper than 64, more than 10 million nodes, a file above 256 MiB,
// bytes that are not UTF-8.
struct YamlNode {
  enum class Kind { kNull, kScalar, kSequence, kMap };

  Kind kind = Kind::kNull;
  bool quoted = false;  // "1" is text, 1 is a number
  std::string scalar;
  std::vector<YamlNode> items;                         // kSequence
  std::vector<std::pair<YamlNode, YamlNode>> entries;  // kMap, in the file's order
  Location where;
};

struct YamlLimits {
  int depth = 64;           // lists and mappings inside one another
  long nodes = 10'000'000;  // values, keys, lists and mappings
  long bytes = 256L << 20;  // of the file
};

YamlNode ParseYamlFile(const std::string& path, const YamlLimits& limits = {});
YamlNode ParseYamlText(std::string_view text,
                       const std::string& name_in_messages,
                       const YamlLimits& limits = {});

// What a node is, for the "found" of a message: "the text 'abc'", "a list of 4", "nothing", ...
std::string Describe(const YamlNode& node);

// Each throws InputError(where, found, expected) when the node is something else.
std::string ReadText(const YamlNode& node, std::string_view expected = "text");
double ReadNumber(const YamlNode& node, std::string_view expected = "a number");  // finite
long ReadInteger(const YamlNode& node, std::string_view expected = "a whole number");
bool ReadBool(const YamlNode& node, std::string_view expected = "true or false");
const std::vector<YamlNode>& ReadSequence(const YamlNode& node,
                                          std::string_view expected = "a list");
// size numbers exactly.
std::vector<double> ReadNumbers(const YamlNode& node, std::size_t size, std::string_view expected);

// A mapping with a fixed set of keys. The constructor refuses unknown keys, naming the nearest
// known one.
class MapReader {
 public:
  // what: the mapping in words, for messages ("the dataset", "measurement").
  MapReader(const YamlNode& node,
            std::string_view what,
            const std::vector<std::string_view>& known_keys);

  const YamlNode& Required(std::string_view key) const;  // InputError if missing
  const YamlNode* Optional(std::string_view key) const;  // nullptr if missing
  bool Has(std::string_view key) const { return Optional(key) != nullptr; }
  const Location& where() const { return node_->where; }

 private:
  const YamlNode* node_;
  std::string what_;
};

}  // namespace hexcal
