// SPDX-License-Identifier: BSD-3-Clause
// The examples that help shows: each is run as it stands.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "apps/command.h"
#include "testing/run_program.h"
#include "testing/temporary_folder.h"

namespace hexcal {
namespace {

namespace fs = std::filesystem;
using ::hexcal::testing::ProgramResult;
using ::hexcal::testing::RunHexcal;
using ::hexcal::testing::RunProgram;
using ::hexcal::testing::TemporaryFolder;

// A shell in the folder, to which hexcal is the built one.
ProgramResult Shell(const std::string& line, const TemporaryFolder& folder) {
  const char* path = std::getenv("PATH");
  const std::string own = fs::path(HEXCAL_PROGRAM).parent_path().string();
  return RunProgram("/bin/bash",
                    {{"-c", line},
                     folder.Path(""),
                     {{"PATH", own + ":" + (path == nullptr ? "/bin:/usr/bin" : path)}}});
}

// Some use what others leave: calibrate goes first.
std::vector<CommandExample> InOrder() {
  std::vector<CommandExample> examples = FindCommand("calibrate")->examples;
  for (const Command& command : Commands())
    if (command.name != "calibrate")
      examples.insert(examples.end(), command.examples.begin(), command.examples.end());
  return examples;
}

TEST(CliExamples, AllWork) {
  const TemporaryFolder folder;
  fs::create_directory_symlink(HEXCAL_EXAMPLES, folder.Path("examples"));
  for (const CommandExample& example : InOrder()) {
    const ProgramResult result = Shell(std::string(example.line), folder);
    EXPECT_EQ(result.status, 0) << example.line << "\n" << result.err;
    EXPECT_FALSE(example.what.empty());
  }
}

TEST(CliExamples, EveryCommandHasSomeAndHelpShowsThem) {
  const TemporaryFolder folder;
  for (const Command& command : Commands()) {
    const std::string name(command.name);
    EXPECT_FALSE(command.examples.empty()) << name;
    std::string help = RunHexcal({{"help", name}}).out;
    const std::string cut = " \\\n          ";
    for (std::size_t at; (at = help.find(cut)) != std::string::npos;)
      help.replace(at, cut.size(), " ");
    for (const CommandExample& example : command.examples) {
      EXPECT_NE(example.line.find("hexcal " + name), std::string_view::npos) << example.line;
      const std::string shown = "\n      " + std::string(example.line) + "\n";
      EXPECT_NE(help.find(shown), std::string::npos) << shown;
    }
  }
}

// docs/commands.md lists every command, and names every flag.
TEST(CliExamples, DocsNameEveryCommandAndFlag) {
  std::ostringstream text;
  text << std::ifstream(HEXCAL_EXAMPLES "/../docs/commands.md").rdbuf();
  const std::string docs = text.str();
  for (const Command& command : Commands()) {
    const std::string name(command.name);
    EXPECT_NE(docs.find("| `hexcal " + name), std::string::npos) << name;
    for (const CommandFlag& flag : command.flags)
      EXPECT_NE(docs.find("--" + std::string(flag.name)), std::string::npos) << flag.name;
  }
}

}  // namespace
}  // namespace hexcal
