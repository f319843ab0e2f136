// SPDX-License-Identifier: BSD-3-Clause
// Values of a strict YAML document, read as what a caller expects.
#include <gtest/gtest.h>

#include "config/strict_yaml.h"
#include "testing/decimal_comma.h"
#include "testing/input_error_text.h"

namespace hexcal {
namespace {

using testing::InputErrorText;

YamlNode Parse(std::string_view text) { return ParseYamlText(text, "f.yaml"); }

const YamlNode& Value(const YamlNode& map, std::size_t index) {
  return map.entries.at(index).second;
}

std::string NumberError(const std::string& value) {
  const YamlNode root = Parse("v: " + value + "\n");
  return InputErrorText([&] { ReadNumber(Value(root, 0)); });
}

TEST(YamlReaders, ReadsNumbers) {
  EXPECT_EQ(ReadNumber(Value(Parse("v: -1.5e3\n"), 0)), -1500.0);
  EXPECT_EQ(ReadNumber(Value(Parse("v: +2\n"), 0)), 2.0);
  EXPECT_EQ(NumberError("'1.5'"),
            "f.yaml:1:4: found the text '1.5', expected a number (without quotes)");
  EXPECT_EQ(NumberError("'abc'"), "f.yaml:1:4: found the text 'abc', expected a number");
  EXPECT_EQ(
      NumberError("1,5"),
      "f.yaml:1:4: found the text '1,5', expected a number (the decimal point is '.', not ',')");
  EXPECT_EQ(NumberError("1_000"),
            "f.yaml:1:4: found the text '1_000', expected a number (without separators between the "
            "digits)");
  EXPECT_EQ(NumberError("0x10"),
            "f.yaml:1:4: found the text '0x10', expected a number (in decimal, not hexadecimal)");
  for (const char* text : {".nan", ".inf", "-.inf", "+.inf"})
    EXPECT_EQ(NumberError(text),
              std::string("f.yaml:1:4: found the text '") + text +
                  "', expected a number (finite: nan and inf cannot be used)");
  for (const char* text : {"nan", "inf", "-inf", "1e999"})
    EXPECT_EQ(NumberError(text),
              std::string("f.yaml:1:4: found the text '") + text +
                  "', expected a number (finite: nan, inf and too large numbers cannot be used)");
  EXPECT_EQ(NumberError("[1]"), "f.yaml:1:4: found a list of 1, expected a number");
  EXPECT_EQ(NumberError(""), "f.yaml:1:1: found nothing, expected a number");
  EXPECT_EQ(NumberError("true"), "f.yaml:1:4: found the text 'true', expected a number");
}

TEST(YamlReaders, ReadsTheOtherKinds) {
  const YamlNode root = Parse("[7, true, false, abc, 'q', 1.5, yes, 'true', ~, {}, '7', True]");
  const auto error = [&](auto read, std::size_t i) {
    return InputErrorText([&] { read(root.items[i]); });
  };
  const auto integer = [](const YamlNode& n) { ReadInteger(n); };
  const auto boolean = [](const YamlNode& n) { ReadBool(n); };
  const auto text = [](const YamlNode& n) { ReadText(n); };
  const auto list = [](const YamlNode& n) { ReadSequence(n); };
  EXPECT_EQ(ReadInteger(root.items[0]), 7);
  EXPECT_EQ(error(integer, 5), "f.yaml:1:28: found the number 1.5, expected a whole number");
  EXPECT_EQ(error(integer, 10),
            "f.yaml:1:53: found the text '7', expected a whole number (without quotes)");
  EXPECT_TRUE(ReadBool(root.items[1]));
  EXPECT_FALSE(ReadBool(root.items[2]));
  EXPECT_EQ(error(boolean, 6), "f.yaml:1:33: found the text 'yes', expected true or false");
  EXPECT_EQ(error(boolean, 7),
            "f.yaml:1:38: found the text 'true', expected true or false (without quotes)");
  EXPECT_EQ(error(boolean, 11), "f.yaml:1:58: found the text 'True', expected true or false");
  EXPECT_EQ(ReadText(root.items[3]), "abc");
  EXPECT_EQ(ReadText(root.items[4]), "q");
  EXPECT_EQ(ReadText(root.items[0]), "7");
  EXPECT_EQ(error(text, 8), "f.yaml:1:46: found nothing, expected text");
  EXPECT_EQ(error(text, 9), "f.yaml:1:49: found an empty mapping, expected text");
  EXPECT_EQ(ReadSequence(root).size(), 12u);
  EXPECT_EQ(error(list, 3), "f.yaml:1:18: found the text 'abc', expected a list");
}

TEST(YamlReaders, ReadsListsOfNumbersOfExactSize) {
  const YamlNode root = Parse("[[1, -2, 3.5], [1, 2], 5, [1, x, 3]]");
  EXPECT_EQ(ReadNumbers(root.items[0], 3, "[x, y, z]"), (std::vector<double>{1, -2, 3.5}));
  const auto error = [&](std::size_t i) {
    return InputErrorText([&] { ReadNumbers(root.items[i], 3, "[x, y, z]"); });
  };
  EXPECT_EQ(error(1), "f.yaml:1:16: found a list of 2, expected [x, y, z]");
  EXPECT_EQ(error(2), "f.yaml:1:24: found the number 5, expected [x, y, z]");
  EXPECT_EQ(error(3), "f.yaml:1:31: found the text 'x', expected a number in [x, y, z]");
}

TEST(YamlReaders, MapReaderKnowsItsKeys) {
  const YamlNode root = Parse("name: n\nunits: u\n");
  const MapReader reader(root, "the dataset", {"name", "units", "format"});
  EXPECT_EQ(ReadText(reader.Required("name")), "n");
  EXPECT_TRUE(reader.Has("units"));
  EXPECT_FALSE(reader.Has("format"));
  EXPECT_EQ(reader.Optional("format"), nullptr);
  EXPECT_EQ(reader.where().ToString(), "f.yaml:1:1");
  EXPECT_EQ(InputErrorText([&] { reader.Required("format"); }),
            "f.yaml:1:1: found no key 'format' in the dataset, expected 'format: ...', which is "
            "required");
}

std::string MapError(std::string_view text) {
  const YamlNode root = Parse(text);
  return InputErrorText([&] { MapReader(root, "the dataset", {"name", "measurement"}); });
}

TEST(YamlReaders, MapReaderRefusesUnknownKeysAndOtherKinds) {
  EXPECT_EQ(MapError("name: x\nmesurement: 1\n"),
            "f.yaml:2:1: found the unknown key 'mesurement' in the dataset, expected one of name, "
            "measurement (did you mean 'measurement'?)");
  EXPECT_EQ(MapError("name: x\nfoo: 1\n"),
            "f.yaml:2:1: found the unknown key 'foo' in the dataset, expected one of name, "
            "measurement");
  EXPECT_EQ(MapError("{name:x}\n"),
            "f.yaml:1:2: found the unknown key 'name:x' in the dataset, expected one of name, "
            "measurement (is a space missing after ':'?)");
  EXPECT_EQ(
      MapError("name:x\n"),
      "f.yaml:1:1: found the text 'name:x', expected the dataset as a mapping of 'key: value' "
      "(is a space missing after ':'?)");
  EXPECT_EQ(MapError("[1, 2]\n"),
            "f.yaml:1:1: found a list of 2, expected the dataset as a mapping of 'key: value'");
  const YamlNode root = Parse("a: 1\n");
  EXPECT_EQ(InputErrorText([&] { MapReader(root, "it", {"file"}); }),
            "f.yaml:1:1: found the unknown key 'a' in it, expected only file");
}

TEST(YamlReaders, DoesNotCareForTheLocale) {
  const testing::DecimalComma locale;
  std::string text(2000, '\n');
  const YamlNode root = Parse(text + "a: 1234.5\n");
  EXPECT_EQ(ReadNumber(Value(root, 0)), 1234.5);
  EXPECT_EQ(Value(root, 0).where.ToString(), "f.yaml:2001:4");
  EXPECT_EQ(InputErrorText([&] { Parse(text + "a: @\n"); }).rfind("f.yaml:2001:4: ", 0), 0u);
}

}  // namespace
}  // namespace hexcal
