// SPDX-License-Identifier: BSD-3-Clause
// The built program from outside: exit statuses, what goes to stdout and what to stderr, which
// files appear.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

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
using ::hexcal::testing::TemporaryFolder;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

ProgramResult Call(const std::vector<std::string>& arguments, const std::string& folder = ".") {
  return RunHexcal({arguments, folder});
}

// Wrong usage: status 2, one message on stderr, nothing on stdout.
void ExpectWrongUsage(const std::vector<std::string>& arguments, const std::string& message) {
  const ProgramResult result = Call(arguments);
  EXPECT_EQ(result.status, 2) << result.err;
  EXPECT_THAT(result.out, IsEmpty());
  EXPECT_THAT(result.err, StartsWith("hexcal: "));
  EXPECT_THAT(result.err, HasSubstr(message));
}

// ---- help

TEST(Cli, HelpGoesToStdoutWithStatusZero) {
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"help"}, {"--help"}, {"-h"}, {"help", "help"}}) {
    const ProgramResult result = Call(arguments);
    EXPECT_EQ(result.status, 0);
    EXPECT_THAT(result.err, IsEmpty());
    EXPECT_THAT(result.out, HasSubstr("hexcal COMMAND [FILES] [--flags]"));
    for (const Command& command : Commands())
      EXPECT_THAT(result.out, HasSubstr("  " + std::string(command.name) + " "));
  }
}

TEST(Cli, EveryCommandExplainsItselfAndAllItsFlags) {
  for (const Command& command : Commands()) {
    const std::string name(command.name);
    const ProgramResult result = Call({"help", name});
    EXPECT_EQ(result.status, 0);
    EXPECT_THAT(result.err, IsEmpty());
    EXPECT_THAT(result.out,
                StartsWith("hexcal " + name +
                           (command.flags.empty() && command.arguments.empty() ? "\n" : " ")));
    for (const CommandFlag& flag : command.flags)
      EXPECT_THAT(result.out, HasSubstr("\n  --" + std::string(flag.name)));
    EXPECT_EQ(Call({name, "--help"}).out, result.out);
    EXPECT_EQ(Call({name, "-h", "--nonsense"}).out, result.out);
    for (std::size_t at = 0; at < result.out.size(); at = result.out.find('\n', at) + 1)
      EXPECT_LE(result.out.find('\n', at) - at, 100U) << result.out.substr(at, 100);
  }
}

TEST(Cli, HelpKeepsBuildPathsAndGflagsOwnFlagsToItself) {
  for (const Command& command : Commands()) {
    const std::string help = Call({"help", std::string(command.name)}).out;
    EXPECT_THAT(help, Not(HasSubstr(".cc")));
    EXPECT_THAT(help, Not(HasSubstr("flagfile")));
    EXPECT_THAT(help, Not(HasSubstr("logtostderr")));
  }
}

TEST(Cli, VersionNamesTheLibraries) {
  const ProgramResult result = Call({"--version"});
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(result.out, StartsWith("hexcal "));
  EXPECT_THAT(result.out, HasSubstr("\nCeres Solver "));
  EXPECT_THAT(result.out, HasSubstr("\nrevision "));
  EXPECT_THAT(result.err, IsEmpty());
}

// ---- the tables of commands and flags

TEST(Cli, EveryFlagOfEveryCommandIsInTheTableOfFlags) {
  for (const Command& command : Commands()) {
    for (const CommandFlag& flag : command.flags) {
      const FlagSpec* spec = FindFlag(flag.name);
      ASSERT_NE(spec, nullptr) << flag.name;
      EXPECT_TRUE(IsSwitch(*spec) || !ExpectedText(*spec).empty());
    }
  }
}

TEST(Cli, EveryDefaultThatIsAChoiceIsOneOfTheChoices) {
  for (const FlagSpec& spec : FlagSpecs()) {
    if (spec.choices.empty() || CurrentText(spec).empty()) continue;
    EXPECT_FALSE(SetFlag(spec, CurrentText(spec)).has_value()) << spec.name;
  }
}

// ---- wrong usage

TEST(Cli, WithoutACommandItSaysHowToStart) { ExpectWrongUsage({}, "Try 'hexcal help'."); }

TEST(Cli, AnUnknownCommandGetsTheNearestOne) {
  ExpectWrongUsage({"predikt"}, "unknown command 'predikt' (did you mean 'predict'?)");
  ExpectWrongUsage({"help", "simulat"}, "(did you mean 'simulate'?)");
  ExpectWrongUsage({"xyzzy"}, "unknown command 'xyzzy'\n");
}

TEST(Cli, TheCommandComesFirst) {
  ExpectWrongUsage({"--quiet", "predict"}, "expected a command first");
}

TEST(Cli, AnUnknownFlagGetsTheNearestOne) {
  ExpectWrongUsage({"simulate", "d.yaml", "--sead=3"},
                   "unknown flag --sead (did you mean '--seed'?)");
  ExpectWrongUsage({"simulate", "d.yaml", "--zzzzzz"}, "unknown flag --zzzzzz\n");
}

TEST(Cli, AFlagOfAnotherCommandSaysWhose) {
  ExpectWrongUsage(
      {"predict", "d.yaml", "--seed=3"},
      "predict: takes no --seed (that is for audit, compare, discover, plan, simulate)");
}

TEST(Cli, GflagsOwnFlagsAreUnknown) {
  for (const char* flag : {"--flagfile=x",
                           "--fromenv=quiet",
                           "--tryfromenv=quiet",
                           "--undefok=x",
                           "--helpfull",
                           "--helpxml",
                           "--tab_completion_word=x",
                           "--logtostderr",
                           "--log_dir=."})
    ExpectWrongUsage({"predict", "d.yaml", flag}, "unknown flag --");
}

TEST(Cli, ABadValueSaysWhatIsExpected) {
  const std::vector<std::string> start = {"simulate", "d.yaml"};
  const auto with = [&](const std::string& flag) {
    std::vector<std::string> arguments = start;
    arguments.push_back(flag);
    return arguments;
  };
  for (const char* value : {"nan", "inf", "-1", "", "1e999", "1,5", "0x10", "2 ", "many"})
    ExpectWrongUsage(with(std::string("--noise=") + value),
                     std::string("--noise: found '") + value + "', expected a number from 0 to");
  for (const char* value : {"-1", "1.5", "9223372036854775808", "one"})
    ExpectWrongUsage(with(std::string("--seed=") + value), "expected a whole number from 0 on");
  ExpectWrongUsage(with("--quiet=maybe"), "expected true or false");
  ExpectWrongUsage(with("--out="), "expected a path");
}

TEST(Cli, AMisspeltChoiceGetsTheNearestOne) {
  ExpectWrongUsage({"calibrate", "d.yaml", "--solver=linearised"},
                   "expected nonlinear or linearized (did you mean 'linearized'?)");
  ExpectWrongUsage({"calibrate", "d.yaml", "--loss=hubre"}, "(did you mean 'huber'?)");
  ExpectWrongUsage({"calibrate", "d.yaml", "--loss=l2"}, "huber, cauchy or tukey\n");
}

TEST(Cli, AValueMayStandApartAndMustBeThere) {
  ExpectWrongUsage({"simulate", "d.yaml", "--noise", "x"}, "--noise: found 'x'");
  ExpectWrongUsage({"simulate", "d.yaml", "--noise"}, "--noise has no value");
  ExpectWrongUsage({"simulate", "d.yaml", "--noise", "--quiet"}, "--noise has no value");
}

TEST(Cli, AFlagGivenTwiceIsRefused) {
  ExpectWrongUsage({"simulate", "d.yaml", "--seed=1", "--seed=1"}, "--seed is given twice");
  ExpectWrongUsage({"simulate", "d.yaml", "--quiet", "--noquiet"}, "--quiet is given twice");
}

TEST(Cli, SwitchesAreNegatedAndNothingElseIs) {
  ExpectWrongUsage({"predict", "--noquiet"}, "found no file, expected DATASET");
  ExpectWrongUsage({"predict", "d.yaml", "--noout"}, "unknown flag --noout");
}

TEST(Cli, ASingleDashIsNoFlag) {
  ExpectWrongUsage({"predict", "d.yaml", "-out=x"}, "expected a file or a flag with two dashes");
}

TEST(Cli, TheNumberOfFilesIsChecked) {
  ExpectWrongUsage({"predict"}, "found no file, expected DATASET");
  ExpectWrongUsage({"predict", "a.yaml", "b.yaml"}, "found 2 files, expected DATASET");
}

TEST(Cli, ARequiredFlagThatIsMissingIsNamed) {
  ExpectWrongUsage({"predict", "d.yaml", "--out=x.csv"}, "--model=FILE is missing");
  ExpectWrongUsage({"predict", "d.yaml", "--model=m.yaml"}, "--out=FILE.csv is missing");
}

TEST(Cli, AfterTwoDashesEverythingIsAFile) {
  ExpectWrongUsage({"predict", "--", "d.yaml", "--quiet"}, "found 2 files");
  ExpectWrongUsage({"predict", "--", "--help"}, "--model=FILE is missing");
}

TEST(Cli, AMissingDatasetIsARefusedInput) {
  const TemporaryFolder folder;
  const ProgramResult result =
      Call({"predict", folder.Path("none.yaml"), "--model=m.yaml", "--out=x.csv"}, folder.Path(""));
  EXPECT_EQ(result.status, 3) << result.err;
  EXPECT_THAT(result.err, HasSubstr("none.yaml"));
  EXPECT_THAT(folder.Names(), IsEmpty());
}

TEST(Cli, LogSettingsOfTheEnvironmentLeaveNoFiles) {
  const TemporaryFolder folder;
  const ProgramResult result = RunHexcal({{"predict", "none.yaml", "--model=m.yaml", "--out=x.csv"},
                                          folder.Path(""),
                                          {{"GLOG_logtostderr", "0"},
                                           {"GLOG_logtostdout", "1"},
                                           {"GLOG_log_dir", folder.Path("")},
                                           {"GLOG_v", "3"},
                                           {"TMPDIR", folder.Path("")}}});
  EXPECT_EQ(result.status, 3);
  EXPECT_THAT(result.out, IsEmpty());
  EXPECT_THAT(folder.Names(), IsEmpty());
}

TEST(Cli, AFullDiskUnderStdoutIsAnErrorOfWriting) {
  EXPECT_EQ(RunHexcal({{"help"}, ".", {}, "/dev/full"}).status, 5);
  // More than a buffer: it shows in the middle of the text.
  const ProgramResult result = RunHexcal({{"help", "calibrate"}, ".", {}, "/dev/full"});
  EXPECT_EQ(result.status, 5);
  EXPECT_THAT(result.err, HasSubstr("cannot write to standard output"));
}

TEST(Cli, AFullDiskUnderStderrChangesNothing) {
  const std::string command = std::string("exec ") + HEXCAL_PROGRAM + " calibrate nothing --out=x";
  EXPECT_EQ(testing::RunProgram("/bin/bash", {{"-c", command + " 2>/dev/full"}}).status, 3);
}

}  // namespace
}  // namespace hexcal
