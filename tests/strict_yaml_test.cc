// SPDX-License-Identifier: BSD-3-Clause
#include "config/strict_yaml.h"

#include <gtest/gtest.h>

#include "testing/input_error_text.h"
#include "testing/random.h"
#include "testing/temporary_folder.h"

namespace hexcal {
namespace {

using Kind = YamlNode::Kind;
using testing::InputErrorText;

YamlNode Parse(std::string_view text) { return ParseYamlText(text, "f.yaml"); }

std::string ParseError(std::string_view text, const YamlLimits& limits = {}) {
  return InputErrorText([&] { ParseYamlText(text, "f.yaml", limits); });
}

const YamlNode& Value(const YamlNode& map, std::size_t index) {
  return map.entries.at(index).second;
}

std::string Where(const YamlNode& node) { return node.where.ToString(); }

TEST(StrictYaml, EveryKindOfNodeKnowsItsPlace) {
  const YamlNode root =
      Parse("# a comment\na: 1\nlist: [x, 'y', [1.5]]\nmap:\n  k: \"t\"\nempty:\nnil: ~\n");
  ASSERT_EQ(root.kind, Kind::kMap);
  ASSERT_EQ(root.entries.size(), 5u);
  EXPECT_EQ(Where(root), "f.yaml:2:1");
  EXPECT_EQ(root.entries[0].first.scalar, "a");
  EXPECT_EQ(Value(root, 0).scalar, "1");
  EXPECT_FALSE(Value(root, 0).quoted);
  EXPECT_EQ(Where(Value(root, 0)), "f.yaml:2:4");
  const YamlNode& list = Value(root, 1);
  ASSERT_EQ(list.kind, Kind::kSequence);
  ASSERT_EQ(list.items.size(), 3u);
  EXPECT_EQ(Where(list), "f.yaml:3:7");
  EXPECT_TRUE(list.items[1].quoted);
  EXPECT_EQ(Where(list.items[1]), "f.yaml:3:11");
  EXPECT_EQ(list.items[2].items[0].scalar, "1.5");
  EXPECT_TRUE(Value(Value(root, 2), 0).quoted);
  EXPECT_EQ(Where(Value(Value(root, 2), 0)), "f.yaml:5:6");
  EXPECT_EQ(Value(root, 3).kind, Kind::kNull);
  EXPECT_EQ(Where(Value(root, 3)), "f.yaml:6:1");  // at its key
  EXPECT_EQ(Value(root, 4).kind, Kind::kNull);
  EXPECT_EQ(Where(Value(root, 4)), "f.yaml:7:6");
}

TEST(StrictYaml, AllNodesShareOneFileName) {
  const YamlNode root = Parse("a: [1, 2]\n");
  EXPECT_EQ(root.where.file.get(), Value(root, 0).items[1].where.file.get());
}

TEST(StrictYaml, ColumnsCountCharacters) {
  const YamlNode root = Parse("\xC3\xA9t\xC3\xA9: {\xC3\xBC: 1, b: [2, x]}\nb: 3\n");
  const YamlNode& map = Value(root, 0);
  EXPECT_EQ(Where(map), "f.yaml:1:6");
  EXPECT_EQ(Where(Value(map, 0)), "f.yaml:1:10");
  EXPECT_EQ(Where(Value(map, 1).items[1]), "f.yaml:1:20");
  EXPECT_EQ(Where(Value(root, 1)), "f.yaml:2:4");
  // The parser goes back in the line for the value that is missing here.
  const YamlNode alone = Parse("? \xC3\xA9 # x\n");
  EXPECT_EQ(Where(alone.entries[0].first), "f.yaml:1:3");
  EXPECT_EQ(Where(Value(alone, 0)), "f.yaml:1:1");
}

TEST(StrictYaml, TakesByteOrderMarkAndCrlf) {
  const YamlNode root = Parse(
      "\xEF\xBB\xBF"
      "a: 1\r\nb: text\r\n");
  ASSERT_EQ(root.entries.size(), 2u);
  EXPECT_EQ(root.entries[0].first.scalar, "a");
  EXPECT_EQ(Where(root.entries[0].first), "f.yaml:1:1");
  EXPECT_EQ(Value(root, 1).scalar, "text");
  EXPECT_EQ(Where(Value(root, 1)), "f.yaml:2:4");
}

TEST(StrictYaml, EmptyPlacesOfAListAreNull) {
  const YamlNode root = Parse("a:\n  - 1\n  -\n\n  - ~\n  -\nb: [1, , 2]\nc: {x, y: 1}\n");
  const std::vector<YamlNode>& items = Value(root, 0).items;
  ASSERT_EQ(items.size(), 4u);
  EXPECT_EQ(items[1].kind, Kind::kNull);
  EXPECT_EQ(Where(items[1]), "f.yaml:3:3");
  EXPECT_EQ(items[2].kind, Kind::kNull);
  EXPECT_EQ(Where(items[2]), "f.yaml:5:5");
  EXPECT_EQ(items[3].kind, Kind::kNull);
  EXPECT_EQ(Where(items[3]), "f.yaml:6:3");
  EXPECT_EQ(Value(root, 1).items[1].kind, Kind::kNull);
  EXPECT_EQ(Where(Value(root, 1).items[1]), "f.yaml:7:8");
  EXPECT_EQ(Value(Value(root, 2), 0).kind, Kind::kNull);
}

TEST(StrictYaml, RefusesAnchorsAliasesAndTags) {
  const std::string anchor = "found an anchor or alias ('&' or '*'), expected plain values";
  EXPECT_EQ(ParseError("a: &x 1\n").rfind("f.yaml:1:4: " + anchor, 0), 0u)
      << ParseError("a: &x 1\n");
  EXPECT_EQ(ParseError("b: 1\na: *x\n").rfind("f.yaml:2:4: " + anchor, 0), 0u);
  EXPECT_EQ(ParseError("a: &x [1]\nb: *x\n").rfind("f.yaml:1:4: " + anchor, 0), 0u);
  const std::string tag =
      "found a tag ('!'), expected plain values (put a text that starts with '!' in quotes)";
  EXPECT_EQ(ParseError("a: !!str 1\n"), "f.yaml:1:4: " + tag);
  EXPECT_EQ(ParseError("a: ! 12\n"), "f.yaml:1:4: " + tag);
  EXPECT_EQ(ParseError("a: !!null\nb: 1\n"), "f.yaml:1:4: " + tag);
  EXPECT_EQ(ParseError("a: !!map {}\n"), "f.yaml:1:4: " + tag);
  for (const char* text : {"!t a: 1\n", "!t [1]\n", "!t\na: 1\n", "!t 'a'\n", "!<x> 1\n"})
    EXPECT_EQ(ParseError(text), "f.yaml:1:1: " + tag) << text;
  for (const char* text : {"&t a: 1\n", "&t [1]\n", "&t\na: 1\n", "&t 'a'\n", "&t !x 1\n"})
    EXPECT_EQ(ParseError(text).rfind("f.yaml:1:1: " + anchor, 0), 0u) << text;
  EXPECT_EQ(ParseError("a: !mine [1]\n"), "f.yaml:1:4: " + tag);
  EXPECT_EQ(Value(Parse("a: '!x'\n"), 0).scalar, "!x");
}

TEST(StrictYaml, RefusesDuplicateKeysAtTheSecondPlace) {
  EXPECT_EQ(
      ParseError("a: 1\nb: 2\na: 3\n"),
      "f.yaml:3:1: found the key 'a' a second time, expected it once (the first is in line 1)");
  EXPECT_EQ(
      ParseError("m: {k: 1, \"k\": 2}\n"),
      "f.yaml:1:11: found the key 'k' a second time, expected it once (the first is in line 1)");
  EXPECT_EQ(Parse("m: {k: 1}\nn: {k: 2}\n").entries.size(), 2u);
}

TEST(StrictYaml, RefusesKeysThatAreNotWords) {
  const std::string open =
      "' that is not closed, or wrong as key or entries, expected plain keys, ',' between entries "
      "and every bracket closed";
  EXPECT_EQ(ParseError("? [1, 2]\n: x\n"), "f.yaml:1:3: found a '[" + open);
  EXPECT_EQ(ParseError("? {a: 1}\n: x\n"), "f.yaml:1:3: found a '{" + open);
  EXPECT_EQ(ParseError("a: {b: 1, {c: 2}}\n"), "f.yaml:1:11: found a '{" + open);
  EXPECT_EQ(ParseError("a: {b: 1,, c: 2}\n"), "f.yaml:1:4: found a '{" + open);
  EXPECT_EQ(ParseError(std::string(1000000, '[')), "f.yaml:1:1: found a '[" + open);
  const std::string plain =
      "found a key that is not a word, expected 'key: value' with a plain key";
  EXPECT_EQ(ParseError("? - a\n: x\n"), "f.yaml:1:3: " + plain);
  EXPECT_EQ(ParseError("~: x\n"), "f.yaml:1:1: " + plain);
}

TEST(StrictYaml, RefusesASecondDocumentAndAnEmptyOne) {
  EXPECT_EQ(ParseError("a: 1\n---\nb: 1\n"),
            "f.yaml:2:1: found a second document ('---'), expected one document in a file");
  EXPECT_EQ(ParseError("a: 1\n---\n"),
            "f.yaml:2:1: found a second document ('---'), expected one document in a file");
  EXPECT_EQ(ParseError("[1, 2] x\n"),
            "f.yaml:1:8: found more text after the document's end, expected one document (is the "
            "indentation right, is every bracket open?)");
  EXPECT_EQ(ParseError("- a\nb: 1\n").rfind("f.yaml:2:1: found more text after", 0), 0u);
  for (const char* text : {"", "\n\n", "# only a comment\n", "---\n", "~\n"})
    EXPECT_EQ(ParseError(text), "f.yaml: found an empty document, expected 'key: value' lines")
        << text;
  EXPECT_EQ(Parse("---\na: 1\n...\n").entries.size(), 1u);
}

TEST(StrictYaml, LimitsDepth) {
  EXPECT_EQ(ParseError(std::string(64, '[') + std::string(64, ']')), "(no exception)");
  EXPECT_EQ(
      ParseError(std::string(65, '[') + std::string(65, ']')),
      "f.yaml:1:65: found nesting deeper than 64, expected fewer lists and mappings inside one "
      "another");
  const std::string deeper = std::string(100000, '[') + std::string(100000, ']');
  EXPECT_EQ(ParseError(deeper).rfind("f.yaml:1:65: found nesting", 0), 0u);
  std::string deep;
  for (int i = 0; i < 65; ++i) deep += std::string(i, ' ') + "k:\n";
  EXPECT_EQ(ParseError(deep).rfind("f.yaml:65:65: found nesting", 0), 0u) << ParseError(deep);
}

TEST(StrictYaml, LimitsNodesAndBytes) {
  YamlLimits limits;
  EXPECT_EQ(limits.nodes, 10'000'000);
  EXPECT_EQ(limits.bytes, 256L * 1024 * 1024);
  limits.nodes = 4;
  EXPECT_EQ(ParseError("[1, 2, 3]", limits), "(no exception)");
  EXPECT_EQ(
      ParseError("[1, 2, 3, 4]", limits),
      "f.yaml:1:11: found more than 4 values, expected fewer (put large tables in CSV files)");
  limits.bytes = 8;
  EXPECT_EQ(ParseError("[1, 2, 3]", limits),
            "f.yaml: found a text that is too large, expected at most 8 bytes");
}

TEST(StrictYaml, RefusesBytesThatAreNotText) {
  const std::string utf8 =
      "which is not UTF-8, expected UTF-8 text (save the file as UTF-8, not as Latin-1 or "
      "Windows-1252)";
  EXPECT_EQ(ParseError("a: 1\nb: \xE9t\xE9\n"), "f.yaml:2:4: found the byte 0xE9, " + utf8);
  EXPECT_EQ(ParseError("\xC3\xA9: \xC0\xAF\n"), "f.yaml:1:4: found the byte 0xC0, " + utf8);
  EXPECT_EQ(ParseError("a: \xED\xA0\x80\n"),
            "f.yaml:1:4: found the byte 0xED, " + utf8);  // a surrogate
  EXPECT_EQ(ParseError("a: \xF4\x90\x80\x80\n"), "f.yaml:1:4: found the byte 0xF4, " + utf8);
  EXPECT_EQ(ParseError("a: \xE0\x80\x80\n"),
            "f.yaml:1:4: found the byte 0xE0, " + utf8);  // overlong
  EXPECT_EQ(ParseError("a: \xC3"), "f.yaml:1:4: found the byte 0xC3, " + utf8);
  EXPECT_EQ(
      ParseError(std::string_view("a: \0\n", 5)),
      "f.yaml:1:4: found a NUL byte, expected text in UTF-8 (is it UTF-16, or not a text file?)");
  EXPECT_EQ(ParseError(std::string_view("\xFF\xFE"
                                        "a\0",
                                        4)),
            "f.yaml:1:1: found UTF-16 text, expected UTF-8 text (save the file as UTF-8)");
  EXPECT_EQ(ParseError("a: \x04\n"),
            "f.yaml:1:4: found the control character 0x04, expected plain text");
  EXPECT_EQ(
      ParseError("a: 1\rb: 2\r"),
      "f.yaml:1:5: found a carriage return inside a line, expected lines that end in LF or CRLF");
  EXPECT_EQ(Value(Parse("a: \xF0\x9F\x99\x82\n"), 0).scalar, "\xF0\x9F\x99\x82");
}

TEST(StrictYaml, ExplainsSyntaxErrors) {
  const struct {
    const char* text;
    const char* message;
  } cases[] = {
      {"a:\n\tb: 1\n", "2:1: found a tab used as indentation, expected spaces"},
      {"a: 1\n  \tb: 1\n", "2:3: found a tab used as indentation, expected spaces"},
      {"a:1\nb: 2\n", "1:2: found no space after the ':' of 'a:1', expected 'key: value'"},
      {"name x\nb: 2\n", "1:1: found 'name x' without ':', expected 'key: value'"},
      {"a: b: c\n",
       "1:5: found a second ':' in the line, expected quotes around a value that holds ': '"},
      {"a: 1\n  b: 2\n",
       "2:4: found a ':' where no key can stand, expected 'key: value' with the same indentation "
       "as "
       "its neighbours"},
      {"x: 1\na: [1, 2\nb: 3\n",
       "2:4: found a '[' that is not closed before line 3, expected ',' between the items and ']' "
       "after the last"},
      {"a: [[1, 2], [3, 4]\n",
       "1:4: found a '[' that is not closed before line 2, expected ',' between the items and ']' "
       "after the last"},
      {"a: {x: 1\nb: 2\n",
       "1:4: found a '{' that is not closed before line 2, expected ',' between the items and '}' "
       "after the last"},
      {"a: [1, 2}\n",
       "1:9: found '}' without its opening bracket, expected every '[' closed by ']' and every '{' "
       "by '}'"},
      {"a: ]\n",
       "1:4: found ']' without its opening bracket, expected every '[' closed by ']' and every '{' "
       "by '}'"},
      {"a:\n  b: 1\n c: 2\n",
       "3:2: found a line whose indentation fits nothing above it, expected the same indentation "
       "as "
       "its neighbours"},
      {"a: \"b\" c\n",
       "1:8: found 'c' behind a value, expected the end of the line (a value ends with its closing "
       "quote or bracket)"},
      {"a: [1, 2], [3]\n",
       "1:10: found ', [3]' behind a value, expected the end of the line (a value ends with its "
       "closing quote or bracket)"},
      {"a: {x: 1 y: 2}\n",
       "1:4: found a '{' that is not followed by a list of items and '}', expected ',' between the "
       "items and '}' after the last"},
      {"units {length: mm, angle: deg}\n",
       "1:7: found a '{' without ':' before it, expected 'key: {...}'"},
      {"m:\n  k: [1]\n  home [0, 1]\nb: 1\n",
       "3:3: found 'home [0, 1]' without ':', expected 'key: value'"},
      {"a: | text\n  more\n",
       "1:6: found this behind a '|' or '>', expected the end of the line, and the text indented "
       "on "
       "the lines below"},
      {"a: @x\n", "1:4: found a value that starts with '@', expected such a value in quotes"},
      {"a: %x\n", "1:4: found a value that starts with '%', expected such a value in quotes"},
      {"a: - 1\n",
       "1:4: found a list item '- ' here, expected every '- ' on a line of its own, as far to the "
       "right"},
      {"a: \"\\q\"\n",
       "1:7: found a backslash that starts no known escape, expected '\\\\' for a backslash in "
       "double "
       "quotes, or single quotes"},
      {"b: 1\na: \"xx\n", "2:4: found a \" that is not closed, expected a closing quote"},
      {"a: 'it''s\nb: 1\n", "1:4: found a ' that is not closed, expected a closing quote"},
      {"a: \"x\\\"\nb: 1\n", "1:4: found a \" that is not closed, expected a closing quote"},
  };
  for (const auto& c : cases)
    EXPECT_EQ(ParseError(c.text), std::string("f.yaml:") + c.message) << c.text;
}

// Whatever the damage, the text is read or refused with the file's name in front.
TEST(StrictYaml, DamagedTextIsReadOrRefused) {
  const std::string text =
      "# c\nformat: hexcal/dataset/1\nname: 'n-60'\nunits: {length: mm, angle: deg}\n"
      "hexapod:\n  base_joints: [[1, 2, 3], [4, 5.5, -6e-3]]\n  home: [0, 0, 1]\ntext: |\n  some\n"
      "robot_poses:\n  rows:\n    - [pose, x]\n    - [\"1\", ~]\n    -\n  noise: {position: 0.1}\n";
  const std::string_view bytes("\n \t:,-[]{}#&*!|>'\"%@`?~a1\\\r\0\x80\xC3\xA9", 31);
  std::mt19937_64 rng = testing::SeededByTest();
  int read = 0, refused = 0;
  for (int i = 0; i < 5000; ++i) {
    std::string damaged = text;
    for (int j = 0; j <= i % 3; ++j) {
      const std::size_t at = rng() % damaged.size();
      if (rng() % 3 == 0)
        damaged.erase(at, 1 + rng() % 4);
      else
        damaged.insert(at, 1, bytes[rng() % bytes.size()]);
    }
    const std::string error = ParseError(damaged);
    ++(error == "(no exception)" ? read : refused);
    ASSERT_TRUE(error == "(no exception)" || error.rfind("f.yaml", 0) == 0) << damaged;
  }
  EXPECT_GT(read, 500);
  EXPECT_GT(refused, 500);
}

TEST(StrictYaml, QuotesThatAreClosedAreRead) {
  EXPECT_EQ(Value(Parse("a: 'it''s'\n"), 0).scalar, "it's");
  EXPECT_EQ(Value(Parse("a: \"a \\\"b\\\" \\\\\"\n"), 0).scalar, "a \"b\" \\");
  EXPECT_EQ(Value(Parse("a: ''"), 0).scalar, "");
  EXPECT_TRUE(Value(Parse("a: ''"), 0).quoted);
}

TEST(StrictYaml, NamesFilesThatCannotBeRead) {
  const testing::TemporaryFolder folder;
  const std::string large = folder.Write("large.yaml", "a: 1\n");
  std::filesystem::resize_file(large, (256u << 20) + 1);  // sparse
  EXPECT_EQ(InputErrorText([&] { ParseYamlFile(large); }),
            large + ": found a file that is too large, expected at most 256 MiB");
  const std::string good = folder.Write("good.yaml", "a: 1\n");
  EXPECT_EQ(ParseYamlFile(good).where.ToString(), good + ":1:1");
  EXPECT_EQ(InputErrorText([] { ParseYamlFile("no/such/file.yaml"); }),
            "no/such/file.yaml: found no file, expected a file that can be read");
  EXPECT_EQ(InputErrorText([] { ParseYamlFile("."); }),
            ".: found no file but a folder, expected a file that can be read");
}

TEST(StrictYaml, DescribesWhatItFound) {
  const YamlNode root =
      Parse(R"([abc, '1', 1.5, [], [1, 2], {}, {a: 1}, {a: 1, b: 2}, ~, "a\nb", nan])");
  const char* expected[] = {"the text 'abc'",
                            "the text '1'",
                            "the number 1.5",
                            "an empty list",
                            "a list of 2",
                            "an empty mapping",
                            "a mapping of 1 key",
                            "a mapping of 2 keys",
                            "nothing",
                            "the text 'a?b'",
                            "the text 'nan'"};
  for (std::size_t i = 0; i < root.items.size(); ++i)
    EXPECT_EQ(Describe(root.items[i]), expected[i]);
  EXPECT_EQ(Describe(Parse(std::string(200, 'x'))), "the text '" + std::string(60, 'x') + "...'");
}

}  // namespace
}  // namespace hexcal
