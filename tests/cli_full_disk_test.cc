// SPDX-License-Identifier: BSD-3-Clause
// Every command that writes, on a disk that is full from its first, second, third... write on: exit
// status 5, a message, an earlier result as it was, and nothing else left behind.
// Not covered: a disk that loses what it said it had written.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "testing/run_program.h"
#include "testing/temporary_folder.h"

namespace hexcal {
namespace {

namespace fs = std::filesystem;
using ::hexcal::testing::ProgramResult;
using ::hexcal::testing::RunHexcal;
using ::hexcal::testing::TemporaryFolder;
using ::testing::HasSubstr;

const std::string kExamples = HEXCAL_EXAMPLES;
const std::string kDataset = kExamples + "/neurobot/dataset.yaml";
const std::string kModel = kExamples + "/neurobot/truth.yaml";

// path below the folder -> content
using Files = std::map<std::string, std::string>;

Files FilesIn(const std::string& folder) {
  Files files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    std::ostringstream content;
    content << std::ifstream(entry.path(), std::ios::binary).rdbuf();
    files[fs::relative(entry.path(), folder).string()] = content.str();
  }
  return files;
}

struct Case {
  std::string name;
  std::vector<std::string> arguments;
  // Every how many calls: what takes long to compute writes as the others do.
  long step = 1;
};

class CliFullDisk : public ::testing::TestWithParam<Case> {
 protected:
  ProgramResult Run(long full_after) const {
    std::vector<std::pair<std::string, std::string>> environment = {
        {"LD_PRELOAD", HEXCAL_FULL_DISK},
        {"HEXCAL_CALLS", logs_.Path("calls")},
        {"ASAN_OPTIONS", "verify_asan_link_order=0"}};
    if (full_after > 0) environment.emplace_back("HEXCAL_FULL_AFTER", std::to_string(full_after));
    return RunHexcal({GetParam().arguments, folder_.Path(""), environment});
  }
  long Calls() const { return std::stol(logs_.Read("calls")); }

  TemporaryFolder folder_, logs_;
};

TEST_P(CliFullDisk, LeavesAnEarlierResultAsItWas) {
  const ProgramResult earlier = Run(0);
  ASSERT_THAT(earlier.status, ::testing::AnyOf(0, 4)) << earlier.err;
  const Files before = FilesIn(folder_.Path(""));
  ASSERT_FALSE(before.empty());
  ASSERT_EQ(Run(0).status, earlier.status);
  const long calls = Calls();
  ASSERT_GE(calls, 2);
  const Files again = FilesIn(folder_.Path(""));
  for (long k = 1; k <= calls; k += GetParam().step) {
    SCOPED_TRACE("full from call " + std::to_string(k) + " of " + std::to_string(calls));
    const ProgramResult result = Run(k);
    EXPECT_EQ(result.status, 5) << result.err;
    EXPECT_THAT(result.err, HasSubstr("No space left on device"));
    EXPECT_EQ(FilesIn(folder_.Path("")), again);
  }
}

TEST_P(CliFullDisk, LeavesNothingWhereNothingWas) {
  ASSERT_THAT(Run(0).status, ::testing::AnyOf(0, 4));
  const long calls = Calls();
  for (long k = 1; k <= calls; k += GetParam().step) {
    for (const auto& entry : fs::directory_iterator(folder_.Path(""))) fs::remove_all(entry);
    SCOPED_TRACE("full from call " + std::to_string(k) + " of " + std::to_string(calls));
    EXPECT_EQ(Run(k).status, 5);
    EXPECT_THAT(FilesIn(folder_.Path("")), ::testing::IsEmpty());
  }
}

INSTANTIATE_TEST_SUITE_P(
    Commands,
    CliFullDisk,
    ::testing::Values(
        Case{"calibrate", {"calibrate", kDataset, "--out=out", "--report"}},
        Case{"compare",
             {"compare", kDataset, "--out=out", "--draws=1000", "--starts=0", "--report"},
             3},
        Case{"audit", {"audit", kDataset, "--out=out", "--draws=1000"}, 5},
        Case{"discover", {"discover", kDataset, "--out=out", "--bootstraps=99", "--folds=2"}, 5},
        Case{"predict", {"predict", kDataset, "--model=" + kModel, "--out=out/where.csv"}},
        Case{"simulate", {"simulate", kDataset, "--model=" + kModel, "--out=out"}},
        Case{"pivot", {"pivot", kExamples + "/pivot/pivoting.yaml", "--out=out"}},
        Case{"init", {"init", "--out=out"}},
        Case{"import",
             {"import",
              "ndi_csv",
              kExamples + "/ndi-and-pi/tracker.csv",
              "--robot=" + kExamples + "/ndi-and-pi/hexapod.dat",
              "--base=0x0A",
              "--tool=0x0B",
              "--pair=rows",
              "--out=out"}}),
    [](const auto& command) { return command.param.name; });

// What a batch had finished stays, a share of one too, and the same command does the rest once
// there is room.
class CliFullDiskBatch : public ::testing::TestWithParam<std::string> {
 protected:
  ProgramResult Run(const std::string& out, const std::string& share, long full_after) const {
    std::vector<std::string> arguments = {"batch", "m.yaml", "--quiet", "--out=" + out};
    if (!share.empty()) arguments.push_back(share);
    std::vector<std::pair<std::string, std::string>> environment = {
        {"LD_PRELOAD", HEXCAL_FULL_DISK},
        {"HEXCAL_CALLS", logs_.Path("calls")},
        {"ASAN_OPTIONS", "verify_asan_link_order=0"}};
    if (full_after > 0) environment.emplace_back("HEXCAL_FULL_AFTER", std::to_string(full_after));
    return RunHexcal({arguments, folder_.Path(""), environment});
  }

  TemporaryFolder folder_, logs_;
};

TEST_P(CliFullDiskBatch, GoesOnOnceThereIsRoom) {
  constexpr long kStep = 5;
  folder_.Write(
      "m.yaml",
      "format: hexcal/batch/1\nname: m\nstudy:\n  draws: 8\n  scenarios:\n    - {name: s, "
      "dataset: " +
          kDataset + ", truth: " + kModel + ", poses: 6}\nestimators: [shah]\n");
  ASSERT_EQ(Run("whole", "", 0).status, 0);
  const Files whole = FilesIn(folder_.Path("whole"));
  ASSERT_EQ(Run("count", GetParam(), 0).status, 0);
  const long calls = std::stol(logs_.Read("calls"));
  ASSERT_GE(calls, 2 * kStep);
  for (long k = 1; k <= calls; k += kStep) {
    SCOPED_TRACE("full from call " + std::to_string(k) + " of " + std::to_string(calls));
    fs::remove_all(folder_.Path("out"));
    EXPECT_EQ(Run("out", GetParam(), k).status, 5);
    EXPECT_EQ(Run("out", "", 0).status, 0);
    const Files after = FilesIn(folder_.Path("out"));
    EXPECT_EQ(after.size(), whole.size());
    for (const char* name : {"results.csv", "summary.csv"})
      EXPECT_TRUE(after.count(name) > 0 && after.at(name) == whole.at(name)) << name;
  }
}

INSTANTIATE_TEST_SUITE_P(Batch, CliFullDiskBatch, ::testing::Values("--threads=1", "--task=1/1"));

}  // namespace
}  // namespace hexcal
