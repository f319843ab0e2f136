// SPDX-License-Identifier: BSD-3-Clause
#include "config/strict_yaml.h"

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/mark.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <istream>
#include <optional>
#include <streambuf>
#include <unordered_map>

#include "config/input_file.h"
#include "config/utf8.h"
#include "config/yaml_syntax.h"

namespace hexcal {
namespace {

// Reads the text where it lies.
class ViewBuffer : public std::streambuf {
 public:
  explicit ViewBuffer(std::string_view text) {
    char* begin = const_cast<char*>(text.data());  // a get area is only read
    setg(begin, begin, begin + text.size());
  }
};

// Turns the parser's marks (bytes, from 0) into lines and columns (characters, from 1). Marks come
// mostly in order, so a column is counted on from the one before: linear even in one long line.
class Places {
 public:
  Places(std::string_view text, const std::string& name)
      : text_(text), file_(std::make_shared<const std::string>(name)) {}

  Location At(const YAML::Mark& mark) {
    const std::size_t offset = Offset(mark);
    const auto line_start = offset - std::min(offset, static_cast<std::size_t>(mark.column));
    if (mark.line != line_ || offset < offset_) {
      line_ = mark.line;
      offset_ = line_start;
      column_ = 1;
    }
    column_ += CountCharacters(text_.substr(offset_, offset - offset_));
    offset_ = offset;
    return {file_, mark.line + 1, column_};
  }

  Location AtOffset(std::size_t offset) const {
    const std::string_view before = text_.substr(0, offset);
    const auto lines = std::count(before.begin(), before.end(), '\n');
    const std::string_view line = before.substr(before.rfind('\n') + 1);  // npos + 1 is 0
    return {file_, static_cast<int>(lines) + 1, CountCharacters(line) + 1};
  }

  std::size_t Offset(const YAML::Mark& mark) const {
    return std::min(static_cast<std::size_t>(std::max(mark.pos, 0)), text_.size());
  }

  Location File() const { return {file_, 0, 0}; }

 private:
  std::string_view text_;
  std::shared_ptr<const std::string> file_;
  int line_ = -1;
  std::size_t offset_ = 0;
  int column_ = 1;
};

// Builds the tree from the parser's events and refuses what we do not take.
class TreeBuilder : public YAML::EventHandler {
 public:
  TreeBuilder(std::string_view text, Places& places, const YamlLimits& limits)
      : text_(text), places_(places), limits_(limits) {}

  YamlNode& Root() { return root_; }

  std::size_t OpenBracket() const {
    for (auto frame = open_.rbegin(); frame != open_.rend(); ++frame)
      if (frame->offset < text_.size() &&
          (text_[frame->offset] == '[' || text_[frame->offset] == '{'))
        return frame->offset;
    return kNoBracket;
  }

  void OnDocumentStart(const YAML::Mark& mark) override {
    if (++documents_ == 1) return;
    const bool marked = text_.substr(places_.Offset(mark), 3) == "---";
    throw InputError(places_.At(mark),
                     marked ? "a second document ('---')" : "more text after the document's end",
                     marked ? "one document in a file"
                            : "one document (is the indentation right, is every bracket open?)");
  }
  void OnDocumentEnd() override {}

  void OnAlias(const YAML::Mark& mark, YAML::anchor_t /*anchor*/) override { RefuseAnchor(mark); }

  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    RefuseAnchorAndTag(mark, anchor);
    YamlNode node = NewNode(YamlNode::Kind::kNull, mark);
    node.where = NullLocation(mark);
    Add(std::move(node));
  }

  void OnScalar(const YAML::Mark& mark,
                const std::string& tag,
                YAML::anchor_t anchor,
                const std::string& value) override {
    RefuseAnchorAndTag(mark, anchor);
    YamlNode node = NewNode(YamlNode::Kind::kScalar, mark);
    node.quoted = tag == "!";
    node.scalar = value;
    const std::size_t offset = places_.Offset(mark);
    const char first = offset < text_.size() ? text_[offset] : ' ';
    if ((first == '"' || first == '\'') && !QuoteIsClosed(text_, offset))
      throw InputError(
          node.where, fmt::format("a {} that is not closed", first), "a closing quote");
    Add(std::move(node));
  }

  void OnSequenceStart(const YAML::Mark& mark,
                       const std::string& /*tag*/,
                       YAML::anchor_t anchor,
                       YAML::EmitterStyle::value /*style*/) override {
    Open(YamlNode::Kind::kSequence, mark, anchor);
  }
  void OnMapStart(const YAML::Mark& mark,
                  const std::string& /*tag*/,
                  YAML::anchor_t anchor,
                  YAML::EmitterStyle::value /*style*/) override {
    Open(YamlNode::Kind::kMap, mark, anchor);
  }
  void OnSequenceEnd() override { Close(); }
  void OnMapEnd() override { Close(); }

 private:
  // A list or mapping that is not yet at its end.
  struct Frame {
    YamlNode node;
    std::size_t offset = 0;
    std::optional<YamlNode> key;                     // of a mapping, its value still to come
    std::unordered_map<std::string, int> key_lines;  // of a mapping
  };

  [[noreturn]] void RefuseAnchor(const YAML::Mark& mark) {
    throw InputError(places_.At(mark),
                     "an anchor or alias ('&' or '*')",
                     "plain values (repeat the value, or put a text that starts so in quotes)");
  }

  // Both stand before the node, so that its mark is theirs.
  void RefuseAnchorAndTag(const YAML::Mark& mark, YAML::anchor_t anchor) {
    if (anchor != 0) RefuseAnchor(mark);
    const std::size_t offset = places_.Offset(mark);
    if (offset < text_.size() && text_[offset] == '!')
      throw InputError(places_.At(mark),
                       "a tag ('!')",
                       "plain values (put a text that starts with '!' in quotes)");
  }

  YamlNode NewNode(YamlNode::Kind kind, const YAML::Mark& mark) {
    if (++nodes_ > limits_.nodes)
      throw InputError(places_.At(mark),
                       fmt::format("more than {} values", limits_.nodes),
                       "fewer (put large tables in CSV files)");
    YamlNode node;
    node.kind = kind;
    node.where = places_.At(mark);
    return node;
  }

  // The parser reports a missing value at whatever comes next: say where it is missing instead.
  Location NullLocation(const YAML::Mark& mark) {
    Location at = places_.At(mark);
    if (open_.empty()) return at;
    const Frame& frame = open_.back();
    if (frame.key && at.line != frame.key->where.line) return frame.key->where;
    if (frame.key || frame.node.kind != YamlNode::Kind::kSequence) return at;
    const std::size_t offset = places_.Offset(mark);
    const std::size_t last = text_.substr(0, offset).find_last_not_of(" \t\r\n");
    const bool here = last == std::string_view::npos || text_[last] != '-' ||
                      text_.substr(last, offset - last).find('\n') == std::string_view::npos;
    return here ? at : places_.AtOffset(last);
  }

  void Open(YamlNode::Kind kind, const YAML::Mark& mark, YAML::anchor_t anchor) {
    RefuseAnchorAndTag(mark, anchor);
    if (static_cast<int>(open_.size()) >= limits_.depth)
      throw InputError(places_.At(mark),
                       fmt::format("nesting deeper than {}", limits_.depth),
                       "fewer lists and mappings inside one another");
    Frame frame;
    frame.node = NewNode(kind, mark);
    frame.offset = places_.Offset(mark);
    if (!open_.empty() && ExpectsKey(open_.back())) RefuseKey(frame.node, frame.offset);
    open_.push_back(std::move(frame));
  }

  void Close() {
    YamlNode node = std::move(open_.back().node);
    open_.pop_back();
    Add(std::move(node));
  }

  static bool ExpectsKey(const Frame& frame) {
    return frame.node.kind == YamlNode::Kind::kMap && !frame.key;
  }

  // A bracket that is not closed may look like a key to the parser, or seem to hold a missing one.
  [[noreturn]] void RefuseKey(const YamlNode& node, std::size_t offset) const {
    const char first = offset < text_.size() ? text_[offset] : ' ';
    if (first != '[' && first != '{')
      throw InputError(node.where, "a key that is not a word", "'key: value' with a plain key");
    throw InputError(node.where,
                     fmt::format("a '{}' that is not closed, or wrong as key or entries", first),
                     "plain keys, ',' between entries and every bracket closed");
  }

  void Add(YamlNode node) {
    if (open_.empty()) {
      root_ = std::move(node);
      return;
    }
    Frame& frame = open_.back();
    if (frame.node.kind == YamlNode::Kind::kSequence) {
      frame.node.items.push_back(std::move(node));
    } else if (frame.key) {
      frame.node.entries.emplace_back(std::move(*frame.key), std::move(node));
      frame.key.reset();
    } else {
      SetKey(frame, std::move(node));
    }
  }

  void SetKey(Frame& frame, YamlNode key) {
    if (key.kind != YamlNode::Kind::kScalar) {
      const bool flow = frame.offset < text_.size() && text_[frame.offset] == '{';
      RefuseKey(flow ? frame.node : key, flow ? frame.offset : kNoBracket);
    }
    const auto [entry, is_new] = frame.key_lines.emplace(key.scalar, key.where.line);
    if (!is_new)
      throw InputError(key.where,
                       fmt::format("the key '{}' a second time", Shorten(key.scalar)),
                       fmt::format("it once (the first is in line {})", entry->second));
    frame.key = std::move(key);
  }

  std::string_view text_;
  Places& places_;
  YamlLimits limits_;
  YamlNode root_;
  std::vector<Frame> open_;
  long nodes_ = 0;
  int documents_ = 0;
};

}  // namespace

YamlNode ParseYamlText(std::string_view text,
                       const std::string& name_in_messages,
                       const YamlLimits& limits) {
  if (text.substr(0, kByteOrderMark.size()) == kByteOrderMark)
    text.remove_prefix(kByteOrderMark.size());
  Places places(text, name_in_messages);
  if (static_cast<long>(text.size()) > limits.bytes)
    throw InputError(
        places.File(), "a text that is too large", fmt::format("at most {} bytes", limits.bytes));
  RefuseBadText(text, places.AtOffset(0));
  TreeBuilder builder(text, places, limits);
  try {
    ViewBuffer buffer(text);
    std::istream stream(&buffer);
    YAML::Parser parser(stream);
    while (parser.HandleNextDocument(builder)) {
    }
  } catch (const YAML::Exception& error) {
    const YamlSyntaxError problem =
        ExplainYamlError(text, places.Offset(error.mark), error.msg, builder.OpenBracket());
    throw InputError(places.AtOffset(problem.offset), problem.found, problem.expected);
  }
  if (builder.Root().kind == YamlNode::Kind::kNull)
    throw InputError(places.File(), "an empty document", "'key: value' lines");
  return std::move(builder.Root());
}

YamlNode ParseYamlFile(const std::string& path, const YamlLimits& limits) {
  return ParseYamlText(ReadTextFile(path, limits.bytes), path, limits);
}

}  // namespace hexcal
