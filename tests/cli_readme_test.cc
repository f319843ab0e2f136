// SPDX-License-Identifier: BSD-3-Clause
// What README.md shows is what the program prints: each line "$ build/hexcal ..." of it is run, in
// order, and the lines that follow are its output.
#include <gtest/gtest.h>

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

const std::string kPrompt = "$ build/hexcal ";

struct Shown {
  std::vector<std::string> arguments;
  std::string output;
};

// Blanks at the end of a line and empty lines at the end do not show.
std::string Visible(const std::string& text) {
  std::istringstream lines(text);
  std::string visible;
  for (std::string line; std::getline(lines, line);)
    visible += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  while (visible.size() > 1 && visible.compare(visible.size() - 2, 2, "\n\n") == 0)
    visible.pop_back();
  return visible;
}

std::vector<Shown> ShownCommands(const fs::path& path) {
  std::vector<Shown> commands;
  std::ifstream file(path);
  bool is_output = false;
  for (std::string line; std::getline(file, line);) {
    if (line.rfind(kPrompt, 0) == 0) {
      std::istringstream words(line.substr(kPrompt.size()));
      commands.emplace_back();
      for (std::string word; words >> word;) commands.back().arguments.push_back(word);
      is_output = true;
    } else if (line == "```") {
      is_output = false;
    } else if (is_output) {
      commands.back().output += line + "\n";
    }
  }
  return commands;
}

TEST(Readme, ShowsWhatTheProgramPrints) {
  const fs::path source = HEXCAL_SOURCE;
  const testing::TemporaryFolder here;
  fs::create_directory_symlink(source / "examples", here.Path("examples"));
  const std::vector<Shown> commands = ShownCommands(source / "README.md");
  ASSERT_FALSE(commands.empty());
  for (const Shown& shown : commands) {
    const testing::ProgramResult result = testing::RunHexcal({shown.arguments, here.Path("")});
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(Visible(result.out), Visible(shown.output));
  }
}

}  // namespace
}  // namespace hexcal
