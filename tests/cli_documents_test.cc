// SPDX-License-Identifier: BSD-3-Clause
// What README.md, docs/ and examples/ show is what the program prints: each line "$ ..." of a
// document is run by the shell, in order, in a folder that has examples/ and build/hexcal; it must
// succeed, and the lines that follow it are its output. A line "..." stands for any number of
// lines. A block of nothing but commands says nothing of their output.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "testing/run_program.h"
#include "testing/temporary_folder.h"

namespace hexcal {
namespace {

namespace fs = std::filesystem;

const fs::path kSource = HEXCAL_SOURCE;
const std::string kPrompt = "$ ";

struct Shown {
  int line = 0;
  std::string command;
  std::vector<std::string> output;
  bool has_output = false;  // somewhere in the block
};

// Blanks at the end of a line and empty lines at the end do not show.
std::vector<std::string> VisibleLines(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);)
    lines.push_back(line.substr(0, line.find_last_not_of(' ') + 1));
  while (!lines.empty() && lines.back().empty()) lines.pop_back();
  return lines;
}

template <typename Iterator>
bool HasOutput(Iterator begin, Iterator end) {
  return std::any_of(begin, end, [](const Shown& shown) { return !shown.output.empty(); });
}

std::vector<Shown> ShownCommands(const fs::path& path) {
  std::vector<Shown> commands;
  std::ifstream file(path);
  bool is_block = false, is_output = false;
  int number = 0;
  std::size_t first = 0;  // of the block
  for (std::string line; std::getline(file, line);) {
    ++number;
    if (line.rfind("```", 0) == 0) {
      is_block = !is_block;
      is_output = false;
      const bool has_output = HasOutput(commands.begin() + first, commands.end());
      for (; first < commands.size(); ++first) commands[first].has_output = has_output;
    } else if (is_block && line.rfind(kPrompt, 0) == 0) {
      commands.push_back({number, line.substr(kPrompt.size()), {}, false});
      is_output = true;
      for (; line.back() == '\\' && std::getline(file, line); ++number)
        commands.back().command += "\n" + line;
    } else if (is_output) {
      commands.back().output.push_back(line);
    }
  }
  for (Shown& shown : commands)
    while (!shown.output.empty() && shown.output.back().empty()) shown.output.pop_back();
  return commands;
}

// What is shown, with each "..." replaced by the lines that stand there in truth.
std::vector<std::string> FilledIn(const std::vector<std::string>& shown,
                                  const std::vector<std::string>& truth) {
  std::vector<std::string> filled;
  for (std::size_t i = 0; i < shown.size(); ++i) {
    if (shown[i] != "...") {
      filled.push_back(shown[i]);
      continue;
    }
    auto end = truth.end();
    const auto begin = truth.begin() + std::min(filled.size(), truth.size());
    if (i + 1 < shown.size()) end = std::find(begin, truth.end(), shown[i + 1]);
    filled.insert(filled.end(), begin, end);
  }
  return filled;
}

std::vector<std::string> Documents() {
  std::vector<std::string> documents;
  const auto add = [&](const fs::path& path) {
    if (path.extension() == ".md" && !ShownCommands(path).empty())
      documents.push_back(fs::relative(path, kSource).string());
  };
  for (const auto& entry : fs::directory_iterator(kSource)) add(entry.path());
  for (const char* folder : {"docs", "examples"})
    for (const auto& entry : fs::recursive_directory_iterator(kSource / folder)) add(entry.path());
  std::sort(documents.begin(), documents.end());
  return documents;
}

class Document : public ::testing::TestWithParam<std::string> {};

TEST_P(Document, ShowsWhatTheProgramPrints) {
  const testing::TemporaryFolder here;
  fs::copy(kSource / "examples", here.Path("examples"), fs::copy_options::recursive);
  fs::create_directory(here.Path("build"));
  fs::create_symlink(HEXCAL_PROGRAM, here.Path("build/hexcal"));
  for (const Shown& shown : ShownCommands(kSource / GetParam())) {
    SCOPED_TRACE(GetParam() + ":" + std::to_string(shown.line) + ": " + shown.command);
    const testing::ProgramResult result =
        testing::RunProgram("/bin/sh", {{"-c", shown.command}, here.Path("")});
    EXPECT_EQ(result.status, 0) << result.err;
    const std::vector<std::string> truth = VisibleLines(result.out);
    if (shown.has_output) {
      EXPECT_EQ(truth, FilledIn(shown.output, truth));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, Document, ::testing::ValuesIn(Documents()), [](const auto& test) {
  std::string name = test.param;
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return !std::isalnum(c); }, '_');
  return name;
});

TEST(Documents, AmongThemIsTheReadme) {
  const std::vector<std::string> documents = Documents();
  EXPECT_EQ(std::count(documents.begin(), documents.end(), "README.md"), 1);
  EXPECT_EQ(std::count(documents.begin(), documents.end(), "docs/tutorial.md"), 1);
}

TEST(Documents, AreReadBlockByBlock) {
  const testing::TemporaryFolder here;
  const std::vector<Shown> commands = ShownCommands(
      here.Write("a.md", "$ no\n```\n$ a \\\nb\nc\n\n$ d\n```\ntext\n```\n$ e\n```\n"));
  ASSERT_EQ(commands.size(), 3u);
  EXPECT_EQ(commands[0].line, 3);
  EXPECT_EQ(commands[0].command, "a \\\nb");
  EXPECT_EQ(commands[0].output, std::vector<std::string>{"c"});
  EXPECT_TRUE(commands[0].has_output);
  EXPECT_TRUE(commands[1].has_output);  // prints nothing
  EXPECT_FALSE(commands[2].has_output);
}

TEST(Documents, MayLeaveLinesOut) {
  const std::vector<std::string> truth = {"a", "b", "c", "d"};
  EXPECT_EQ(FilledIn({"a", "...", "d"}, truth), truth);
  EXPECT_EQ(FilledIn({"..."}, truth), truth);
  EXPECT_EQ(FilledIn({"a", "b", "...", "c", "d"}, truth), truth);
  EXPECT_NE(FilledIn({"a", "...", "e"}, truth), truth);
  EXPECT_NE(FilledIn({"b", "...", "d"}, truth), truth);
  EXPECT_NE(FilledIn({"a", "b", "c"}, truth), truth);
}

}  // namespace
}  // namespace hexcal
