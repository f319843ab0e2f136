// SPDX-License-Identifier: BSD-3-Clause
#include "config/table.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "testing/decimal_comma.h"
#include "testing/input_error_text.h"
#include "testing/temporary_folder.h"

namespace hexcal {
namespace {

using testing::InputErrorText;
using testing::TemporaryFolder;

// Messages and places with the folder's name cut off: "t.csv:3:5".
std::string WithoutFolder(std::string text, const TemporaryFolder& folder) {
  const std::string prefix = folder.Path("");
  const std::size_t at = text.find(prefix);
  if (at != std::string::npos) text.erase(at, prefix.size());
  return text;
}

// Reads the whole table; column "x" as numbers where there is one.
void ReadAll(TableReader table) {
  const int x = table.Column("x");
  while (table.Next())
    if (x >= 0) table.Number(x);
}

std::string CsvError(std::string_view content) {
  const TemporaryFolder folder;
  const std::string path = folder.Write("t.csv", content);
  return WithoutFolder(InputErrorText([&] { ReadAll(TableReader::FromFile(path)); }), folder);
}

std::string InlineError(std::string_view rows) {
  const YamlNode node = ParseYamlText(rows, "f.yaml");
  return InputErrorText([&] { ReadAll(TableReader::FromRows(node)); });
}

TEST(Table, ReadsCsv) {
  const TemporaryFolder folder;
  const std::string path = folder.Write(
      "t.csv",
      "\xEF\xBB\xBF# made by hand\r\n\r\n  pose , x,\ty\r\np1,1.5, -2e-3 \r\n  \r\n# note, more\r\n"
      "\xC3\xA9 2,,+7");
  TableReader table = TableReader::FromFile(path);
  EXPECT_EQ(table.header(), (std::vector<std::string>{"pose", "x", "y"}));
  EXPECT_EQ(table.Column("pose"), 0);
  EXPECT_EQ(table.Column("y"), 2);
  EXPECT_EQ(table.Column("z"), -1);
  EXPECT_EQ(WithoutFolder(table.HeaderLocation(0).ToString(), folder), "t.csv:3:3");
  EXPECT_EQ(WithoutFolder(table.HeaderLocation(2).ToString(), folder), "t.csv:3:13");
  EXPECT_EQ(WithoutFolder(table.where().ToString(), folder), "t.csv");

  ASSERT_TRUE(table.Next());
  EXPECT_EQ(table.Text(0), "p1");
  EXPECT_EQ(table.Number(1), 1.5);
  EXPECT_EQ(table.Number(2), -2e-3);
  EXPECT_FALSE(table.Empty(1));
  EXPECT_EQ(WithoutFolder(table.RowLocation().ToString(), folder), "t.csv:4");
  EXPECT_EQ(WithoutFolder(table.CellLocation(2).ToString(), folder), "t.csv:4:9");

  ASSERT_TRUE(table.Next());
  EXPECT_EQ(table.Text(0), "\xC3\xA9 2");
  EXPECT_TRUE(table.Empty(1));
  EXPECT_EQ(table.Number(2), 7.0);
  EXPECT_EQ(WithoutFolder(table.CellLocation(1).ToString(), folder), "t.csv:7:5");
  EXPECT_EQ(WithoutFolder(table.CellLocation(2).ToString(), folder), "t.csv:7:6");
  EXPECT_FALSE(table.Next());
  EXPECT_FALSE(table.Next());
}

TEST(Table, AHeaderAloneIsATable) {
  const TemporaryFolder folder;
  TableReader table = TableReader::FromFile(folder.Write("t.csv", "pose,x"));
  EXPECT_EQ(table.header().size(), 2u);
  EXPECT_FALSE(table.Next());
}

TEST(Table, MovesWithItsPlace) {
  const TemporaryFolder folder;
  TableReader first = TableReader::FromFile(folder.Write("t.csv", "x\n1\n2\n"));
  ASSERT_TRUE(first.Next());
  TableReader second = std::move(first);
  EXPECT_EQ(second.Number(0), 1.0);
  ASSERT_TRUE(second.Next());
  EXPECT_EQ(second.Number(0), 2.0);
}

TEST(Table, RefusesBadHeaders) {
  EXPECT_EQ(CsvError(""), "t.csv: found an empty table, expected a header row with column names");
  EXPECT_EQ(CsvError("# only\n\n"),
            "t.csv: found an empty table, expected a header row with column names");
  EXPECT_EQ(
      CsvError("a,b,a\n"),
      "t.csv:1:5: found the column 'a' a second time, expected it once (the first is column 1)");
  EXPECT_EQ(CsvError("a,,b\n"), "t.csv:1:3: found an empty column name, expected a name");
  EXPECT_EQ(CsvError("a,b,\n"),
            "t.csv:1:5: found an empty column name, expected a name (is there a comma too many?)");
  EXPECT_EQ(
      CsvError("\na,1.5\n"),
      "t.csv:2:3: found the number 1.5 as column name, expected a header row of column names");
  EXPECT_EQ(
      CsvError("pose;x;y\n"),
      "t.csv:1:1: found the single column 'pose;x;y', expected ',' between the columns, not ';'");
  EXPECT_EQ(
      CsvError("pose\tx\n"),
      "t.csv:1:1: found the single column 'pose?x', expected ',' between the columns, not a tab");
  EXPECT_EQ(CsvError("pose x y\n"),
            "t.csv:1:1: found the single column 'pose x y', expected ',' between the columns, not "
            "a space");
  EXPECT_EQ(CsvError("\"pose\",x\n"),
            "t.csv:1:1: found a quote character, expected cells without quotes or commas in them");
}

TEST(Table, RefusesRowsOfAnotherLength) {
  EXPECT_EQ(CsvError("a,b,c\n1,2\n"), "t.csv:2: found 2 cells, expected 3 as in the header");
  EXPECT_EQ(CsvError("a,b\n\n1\n"), "t.csv:3: found 1 cell, expected 2 as in the header");
  EXPECT_EQ(CsvError("pose,x,y\np1,0,5,1,25\n"),
            "t.csv:2: found 5 cells, expected 3 as in the header (is a comma used as the decimal "
            "point?)");
  EXPECT_EQ(
      CsvError("pose,x\np1,1,\n"),
      "t.csv:2: found 3 cells, expected 2 as in the header (is there a comma at the end of the "
      "line?)");
  EXPECT_EQ(CsvError("pose,x\np1;1\n"),
            "t.csv:2: found 1 cell, expected 2 as in the header (columns are separated by ',', not "
            "';')");
  EXPECT_EQ(
      CsvError("pose,x\np1\t1\n"),
      "t.csv:2: found 1 cell, expected 2 as in the header (columns are separated by ',', not by "
      "tabs)");
}

TEST(Table, RefusesBadCells) {
  EXPECT_EQ(CsvError("pose,x\n\xC3\xBC, abc\n"),
            "t.csv:2:4: found 'abc' in column 'x', expected a number");
  EXPECT_EQ(CsvError("pose,x\np,\n"),
            "t.csv:2:3: found an empty cell in column 'x', expected a number");
  EXPECT_EQ(
      CsvError("pose,x\np,nan\n"),
      "t.csv:2:3: found 'nan' in column 'x', expected a number (finite: nan, inf and too large "
      "numbers cannot be used)");
  EXPECT_EQ(
      CsvError("pose,x\np,1e999\n").rfind("t.csv:2:3: found '1e999' in column 'x', expected", 0),
      0u);
  EXPECT_EQ(
      CsvError("pose,x\np,1 mm\n"),
      "t.csv:2:3: found '1 mm' in column 'x', expected a number (one number, without a unit or a "
      "second number behind it)");
  EXPECT_EQ(CsvError("pose,x\np1,1\np2,\"1\"\n"),
            "t.csv:3:4: found a quote character, expected cells without quotes or commas in them");
}

TEST(Table, RefusesBytesThatAreNotText) {
  EXPECT_EQ(
      CsvError("pose,x\n\xC3\xA9,\xE9\n"),
      "t.csv:2:3: found the byte 0xE9, which is not UTF-8, expected UTF-8 text (save the file as "
      "UTF-8, not as Latin-1 or Windows-1252)");
  EXPECT_EQ(
      CsvError(std::string_view("pose,x\np\0,1\n", 12)),
      "t.csv:2:2: found a NUL byte, expected text in UTF-8 (is it UTF-16, or not a text file?)");
  EXPECT_EQ(CsvError(std::string_view("\xFF\xFEp\0", 4)),
            "t.csv:1:1: found UTF-16 text, expected UTF-8 text (save the file as UTF-8)");
  EXPECT_EQ(
      CsvError("pose,x\rp,1\r"),
      "t.csv:1:7: found a carriage return inside a line, expected lines that end in LF or CRLF");
  EXPECT_EQ(CsvError("# \x01\n"),
            "t.csv:1:3: found the control character 0x01, expected plain text");
}

TEST(Table, NamesFilesThatCannotBeRead) {
  EXPECT_EQ(InputErrorText([] { TableReader::FromFile("no/such.csv"); }),
            "no/such.csv: found no file, expected a file that can be read");
  EXPECT_EQ(InputErrorText([] { TableReader::FromFile("/"); }),
            "/: found no file but a folder, expected a file that can be read");
}

TEST(Table, LimitsLinesRowsAndBytes) {
  EXPECT_EQ(CsvError("x\n" + std::string(2 << 20, '1') + "\n"),
            "t.csv:2: found a line longer than 1 MiB, expected a line for each row");
  const TemporaryFolder folder;
  const std::string large = folder.Write("t.csv", "x\n1\n");
  std::filesystem::resize_file(large, (std::uintmax_t{4} << 30) + 1);  // sparse
  EXPECT_EQ(WithoutFolder(InputErrorText([&] { TableReader::FromFile(large); }), folder),
            "t.csv: found a file that is too large, expected at most 4096 MiB");

  std::string rows = "a\n";
  for (int i = 0; i < 10'000'000; ++i) rows += "1\n";
  EXPECT_EQ(CsvError(rows), "(no exception)");
  EXPECT_EQ(CsvError(rows + "1\n"),
            "t.csv:10000002: found more than 10 million rows, expected fewer");
}

// Lines that straddle the reader's buffer in every way, against the same table built in memory.
TEST(Table, RowsDoNotDependOnWhereTheBufferEnds) {
  std::string content = "pose,x\n";
  for (int i = 0; i < 40000; ++i)
    content += std::string(static_cast<std::size_t>(i % 61), ' ') + "p" + std::to_string(i) + "," +
               std::to_string(i) + (i % 3 == 0 ? "\r\n" : "\n");
  content += std::string(700000, '#') + "\nlast,40000";
  const TemporaryFolder folder;
  TableReader table = TableReader::FromFile(folder.Write("t.csv", content));
  int i = 0;
  for (; table.Next() && table.Text(0) != "last"; ++i) {
    ASSERT_EQ(table.Text(0), "p" + std::to_string(i));
    ASSERT_EQ(table.Number(1), i);
    ASSERT_EQ(table.RowLocation().line, i + 2);
  }
  EXPECT_EQ(i, 40000);
  EXPECT_EQ(table.Number(1), 40000.0);
  EXPECT_FALSE(table.Next());
}

TEST(Table, ReadsInlineRows) {
  const YamlNode rows =
      ParseYamlText("- [pose, x, 'note']\n- [1, 2.5, ]\n- ['a,b', ~, \" t \"]\n", "f.yaml");
  EXPECT_EQ(InputErrorText([&] { ReadAll(TableReader::FromRows(rows)); }),
            "f.yaml:2:3: found 2 cells, expected 3 as in the header");

  const YamlNode good =
      ParseYamlText("- [pose, x, 'note']\n- [1, 2.5, ~]\n- ['a,b', , \" t \"]\n", "f.yaml");
  TableReader table = TableReader::FromRows(good);
  EXPECT_EQ(table.header(), (std::vector<std::string>{"pose", "x", "note"}));
  EXPECT_EQ(table.HeaderLocation(1).ToString(), "f.yaml:1:10");
  ASSERT_TRUE(table.Next());
  EXPECT_EQ(table.Text(0), "1");
  EXPECT_EQ(table.Number(1), 2.5);
  EXPECT_TRUE(table.Empty(2));
  EXPECT_EQ(table.CellLocation(1).ToString(), "f.yaml:2:7");
  EXPECT_EQ(table.RowLocation().ToString(), "f.yaml:2:3");
  ASSERT_TRUE(table.Next());
  EXPECT_EQ(table.Text(0), "a,b");
  EXPECT_TRUE(table.Empty(1));
  EXPECT_EQ(table.Text(2), "t");
  EXPECT_FALSE(table.Next());
}

TEST(Table, RefusesBadInlineRows) {
  EXPECT_EQ(
      InlineError("a: 1"),
      "f.yaml:1:1: found a mapping of 1 key, expected a list of rows, the first the column names");
  EXPECT_EQ(InlineError("[]"),
            "f.yaml:1:1: found an empty table, expected a header row with column names");
  EXPECT_EQ(InlineError("[[], [1, 2]]"),
            "f.yaml:1:2: found a row without cells, expected a header row with column names");
  EXPECT_EQ(InlineError("[pose, x]"),
            "f.yaml:1:2: found the text 'pose', expected a row: a list of cells");
  EXPECT_EQ(InlineError("[[pose, x], [1, [2]]]"),
            "f.yaml:1:17: found a list of 1, expected a number, a text or nothing as cell");
  EXPECT_EQ(InlineError("[[pose, x], [1]]"),
            "f.yaml:1:13: found 1 cell, expected 2 as in the header");
  EXPECT_EQ(
      InlineError("[[x, x]]"),
      "f.yaml:1:6: found the column 'x' a second time, expected it once (the first is column 1)");
  EXPECT_EQ(InlineError("[[x, '']]"),
            "f.yaml:1:6: found an empty column name, expected a name (is there a comma too many?)");
  EXPECT_EQ(InlineError("[[x], ['1']]"),
            "f.yaml:1:8: found '1' in column 'x', expected a number (without quotes)");
  EXPECT_EQ(
      InlineError("[[x], ['1,5']]"),
      "f.yaml:1:8: found '1,5' in column 'x', expected a number (the decimal point is '.', not "
      "',')");
  EXPECT_EQ(InlineError("[[x], [~]]"),
            "f.yaml:1:8: found an empty cell in column 'x', expected a number");
}

TEST(Table, DoesNotCareForTheLocale) {
  const testing::DecimalComma locale;
  const TemporaryFolder folder;
  TableReader table = TableReader::FromFile(folder.Write("t.csv", "x,y\n1234.5,1e3\n"));
  ASSERT_TRUE(table.Next());
  EXPECT_EQ(table.Number(0), 1234.5);
  EXPECT_EQ(table.Number(1), 1000.0);
}

}  // namespace
}  // namespace hexcal
