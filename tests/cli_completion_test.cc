// SPDX-License-Identifier: BSD-3-Clause
// hexcal completion, run by the shells themselves.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "apps/command.h"
#include "apps/flag_value.h"
#include "apps/flags.h"
#include "testing/run_program.h"
#include "testing/temporary_folder.h"

namespace hexcal {
namespace {

using ::hexcal::testing::ProgramResult;
using ::hexcal::testing::RunHexcal;
using ::hexcal::testing::RunProgram;
using ::hexcal::testing::TemporaryFolder;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::UnorderedElementsAre;

class Completion : public ::testing::Test {
 protected:
  void SetUp() override {
    folder.Write("hexcal.bash", RunHexcal({{"completion", "bash"}}).out);
    for (const char* file : {"bench.yaml", "notes.txt", "result.json", "with blank.yaml"})
      folder.Write(file, "");
    std::filesystem::create_directory(folder.Path("data"));
  }

  // What bash offers for these words, the last of which is being typed; cut at '=' as bash does.
  std::vector<std::string> Offers(const std::vector<std::string>& words) const {
    std::string list;
    for (const std::string& word : words) list += " '" + word + "'";
    const ProgramResult result =
        RunProgram("/bin/bash",
                   {{"--norc",
                     "-c",
                     "source ./hexcal.bash; COMP_WORDS=(" + list +
                         "); COMP_CWORD=" + std::to_string(words.size() - 1) +
                         R"(; _hexcal; for r in "${COMPREPLY[@]}"; do printf '%s\n' "$r"; done)"},
                    folder.Path("")});
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_THAT(result.err, IsEmpty());
    std::vector<std::string> offers;
    std::istringstream lines(result.out);
    for (std::string line; std::getline(lines, line);) offers.push_back(line);
    return offers;
  }

  TemporaryFolder folder;
};

TEST_F(Completion, IsRegistered) {
  const ProgramResult result = RunProgram(
      "/bin/bash", {{"--norc", "-c", "source ./hexcal.bash; complete -p hexcal"}, folder.Path("")});
  EXPECT_EQ(result.out, "complete -F _hexcal hexcal\n") << result.err;
}

TEST_F(Completion, OffersCommands) {
  EXPECT_THAT(Offers({"hexcal", "cal"}), ElementsAre("calibrate"));
  EXPECT_THAT(Offers({"hexcal", "p"}), UnorderedElementsAre("pivot", "plan", "predict"));
  const std::vector<std::string> all = Offers({"hexcal", ""});
  for (const Command& command : Commands()) EXPECT_THAT(all, Contains(std::string(command.name)));
  EXPECT_THAT(Offers({"hexcal", "help", "sim"}), ElementsAre("simulate"));
}

TEST_F(Completion, OffersTheFlagsOfEachCommand) {
  for (const Command& command : Commands()) {
    const std::vector<std::string> offers = Offers({"hexcal", std::string(command.name), "--"});
    EXPECT_EQ(offers.size(), command.flags.size() + 1) << command.name;
    for (const CommandFlag& flag : command.flags) {
      const std::string end = IsSwitch(*FindFlag(flag.name)) ? "" : "=";
      EXPECT_THAT(offers, Contains("--" + std::string(flag.name) + end)) << command.name;
    }
  }
  EXPECT_THAT(Offers({"hexcal", "calibrate", "bench.yaml", "--so"}), ElementsAre("--solver="));
}

TEST_F(Completion, OffersTheValuesOfAFlag) {
  const auto both = UnorderedElementsAre("nonlinear", "linearized");
  EXPECT_THAT(Offers({"hexcal", "calibrate", "--solver", "="}), both);
  EXPECT_THAT(Offers({"hexcal", "calibrate", "--solver", "=", "lin"}), ElementsAre("linearized"));
  EXPECT_THAT(Offers({"hexcal", "calibrate", "--solver", ""}), both);
  // Where COMP_WORDBREAKS has no '='.
  EXPECT_THAT(Offers({"hexcal", "calibrate", "--solver=lin"}), ElementsAre("--solver=linearized"));
  EXPECT_THAT(Offers({"hexcal", "plan", "--poses", "=", ""}), IsEmpty());
  EXPECT_THAT(Offers({"hexcal", "plan", "--none", "=", ""}), IsEmpty());
}

TEST_F(Completion, OffersFilesByTheirExtension) {
  EXPECT_THAT(Offers({"hexcal", "calibrate", ""}),
              UnorderedElementsAre("bench.yaml", "with blank.yaml", "data"));
  EXPECT_THAT(Offers({"hexcal", "calibrate", "--quiet", "b"}), ElementsAre("bench.yaml"));
  EXPECT_THAT(Offers({"hexcal", "calibrate", "--out", "=", "d"}), ElementsAre("data"));
  EXPECT_THAT(Offers({"hexcal", "calibrate", "--out", "=", "b"}), IsEmpty());
  EXPECT_THAT(Offers({"hexcal", "audit", "bench.yaml", "--previous", "=", ""}),
              UnorderedElementsAre("result.json", "data"));
  EXPECT_THAT(Offers({"hexcal", "import", "ndi_csv", "n"}), ElementsAre("notes.txt"));
}

TEST_F(Completion, OffersTheWordsThatComeFirst) {
  EXPECT_THAT(Offers({"hexcal", "import", "ndi"}), ElementsAre("ndi_csv"));
  EXPECT_THAT(Offers({"hexcal", "import", "--kind", "=", "poses", "tu"}), ElementsAre("tum"));
  EXPECT_THAT(Offers({"hexcal", "export", "urdf", "r"}), ElementsAre("result.json"));
  EXPECT_THAT(Offers({"hexcal", "schema", "data"}), ElementsAre("dataset"));
  EXPECT_THAT(Offers({"hexcal", "schema", "settings", "cal"}), ElementsAre("calibrate"));
  EXPECT_THAT(Offers({"hexcal", "completion", ""}), UnorderedElementsAre("bash", "zsh"));
}

// Quotes and brackets as zsh needs them; zsh itself, where it is installed, must parse it.
TEST_F(Completion, OfZshHasEveryCommandAndFlag) {
  const std::string script = RunHexcal({{"completion", "zsh"}}).out;
  EXPECT_EQ(script.rfind("#compdef hexcal\n", 0), 0u);
  for (const Command& command : Commands()) {
    const std::size_t at = script.find("\n    " + std::string(command.name) + ")\n");
    ASSERT_NE(at, std::string::npos) << command.name;
    const std::string own = script.substr(at, script.find("\n      ;;\n", at) - at);
    for (const CommandFlag& flag : command.flags)
      EXPECT_THAT(own,
                  HasSubstr("'--" + std::string(flag.name) +
                            (IsSwitch(*FindFlag(flag.name)) ? "[" : "=[")));
  }
  std::istringstream lines(script);
  for (std::string line; std::getline(lines, line);) {
    std::string bare = line;
    for (std::size_t cut; (cut = bare.find("'\\''")) != std::string::npos;) bare.erase(cut, 4);
    EXPECT_EQ(std::count(bare.begin(), bare.end(), '\'') % 2, 0) << line;
  }
  const std::string file = folder.Write("_hexcal", script);
  EXPECT_EQ(RunProgram("/bin/bash",
                       {{"-c", "if command -v zsh >/dev/null; then zsh -n " + file + "; fi"}})
                .status,
            0);
}

TEST_F(Completion, RefusesOtherShells) {
  const ProgramResult result = RunHexcal({{"completion", "bsh"}});
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, HasSubstr("(did you mean 'bash'?)"));
}

}  // namespace
}  // namespace hexcal
