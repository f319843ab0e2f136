// SPDX-License-Identifier: BSD-3-Clause
// hexcal batch in several processes: as mpirun starts them, as a Slurm job array does, in any
// split. What mpirun adds (stopping all when one fails) is tested where mpirun is there.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <future>
#include <string>
#include <vector>

#include "testing/run_program.h"
#include "testing/temporary_folder.h"

namespace hexcal {
namespace {

using ::hexcal::testing::ProgramResult;
using ::hexcal::testing::RunHexcal;
using ::hexcal::testing::RunProgram;
using ::hexcal::testing::TemporaryFolder;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

using Arguments = std::vector<std::string>;
using Environment = std::vector<std::pair<std::string, std::string>>;

constexpr int kDatasets = 24;

constexpr const char* kRows = R"(    - [a, 0, 0, 0.4, 0, 0, 0]
    - [b, 0.05, 0, 0.4, 0.3, 0, 0]
    - [c, 0, 0.05, 0.42, 0, 0.3, 0]
    - [d, 0.02, 0.01, 0.38, 0, 0, 0.3]
    - [e, -0.05, 0.03, 0.41, -0.2, 0.2, 0.1]
)";

class CliBatchShares : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    data_ = new TemporaryFolder;
    std::filesystem::create_directory(data_->Path("d"));
    for (int i = 0; i < kDatasets; ++i) {
      std::string measured = kRows;
      measured.replace(measured.find("0.05, 0, 0.4,"), 4, "0.0500" + std::to_string(i));
      data_->Write("d/" + std::to_string(1000 + i) + ".yaml",
                   "format: hexcal/dataset/1\nname: n\nunits: {length: m, angle: rad}\n"
                   "robot_poses:\n  rows:\n    - [pose, x, y, z, rx, ry, rz]\n" +
                       std::string(kRows) +
                       "measurement:\n  kind: poses\n  rows:\n    - [pose, x, y, z, rx, ry, rz]\n" +
                       measured + "  noise: {position: 0.0001, orientation: 0.001}\n");
    }
    data_->Write("m.yaml", "format: hexcal/batch/1\nname: s\ndatasets: [d/*.yaml]\n");
    const ProgramResult alone =
        RunHexcal({{"batch", data_->Path("m.yaml"), "--out=" + data_->Path("alone")}});
    ASSERT_EQ(alone.status, 0) << alone.err;
    csv_ = data_->Read("alone/results.csv");
    ASSERT_THAT(csv_, HasSubstr("\ns,23,done,,d/1023.yaml,"));
  }
  static void TearDownTestSuite() {
    delete data_;
    data_ = nullptr;
  }

  ProgramResult Run(Arguments flags, const Environment& environment = {}) const {
    flags.insert(flags.begin(), {"batch", data_->Path("m.yaml"), "--out=out"});
    return RunHexcal({flags, out.Path(""), environment});
  }

  void ExpectWholeAndNothingElse() const {
    EXPECT_EQ(out.Read("out/results.csv"), csv_);
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(out.Path("out")))
      names.push_back(entry.path().filename().string());
    EXPECT_THAT(names,
                ::testing::UnorderedElementsAre("results.csv", "results.sqlite", "run.json"));
  }

  static TemporaryFolder* data_;
  static std::string csv_;
  TemporaryFolder out;
};

TemporaryFolder* CliBatchShares::data_ = nullptr;
std::string CliBatchShares::csv_;

TEST_F(CliBatchShares, AnySplitGivesTheSameBytes) {
  for (const int count : {1, 2, 3, 5}) {
    std::filesystem::remove_all(out.Path("out"));
    for (int k = count; k >= 1; --k) {
      const std::string task = "--task=" + std::to_string(k) + "/" + std::to_string(count);
      const ProgramResult share = Run({task});
      EXPECT_EQ(share.status, 0) << share.err;
      EXPECT_EQ(share.out, "");
      EXPECT_FALSE(std::filesystem::exists(out.Path("out/results.csv")));
    }
    const ProgramResult merge = Run({"--merge"});
    EXPECT_EQ(merge.status, 0) << merge.err;
    EXPECT_EQ(merge.err, "");
    ExpectWholeAndNothingElse();
  }
}

// All at the same time; whichever ends last merges.
TEST_F(CliBatchShares, RanksGiveTheSameBytesWithoutAMerge) {
  for (const char* rank_of : {"OMPI_COMM_WORLD_", "PMI_"})
    for (const int size : {1, 2, 4}) {
      std::filesystem::remove_all(out.Path("out"));
      std::vector<std::future<ProgramResult>> ranks;
      for (int rank = 0; rank < size; ++rank)
        ranks.push_back(std::async(std::launch::async, [=] {
          return Run({},
                     {{std::string(rank_of) + "RANK", std::to_string(rank)},
                      {std::string(rank_of) + "SIZE", std::to_string(size)}});
        }));
      int tables = 0;
      for (auto& rank : ranks) {
        const ProgramResult result = rank.get();
        EXPECT_EQ(result.status, 0) << result.err;
        if (!result.out.empty()) ++tables;
      }
      EXPECT_EQ(tables, 1);
      ExpectWholeAndNothingElse();
    }
}

// A job that lost some of its ranks, begun again with another number of them.
TEST_F(CliBatchShares, LaterRunsDoWhatRanksLeftUndone) {
  const auto rank = [](int k, int n) {
    return Environment{{"OMPI_COMM_WORLD_RANK", std::to_string(k)},
                       {"OMPI_COMM_WORLD_SIZE", std::to_string(n)}};
  };
  EXPECT_EQ(Run({}, rank(1, 4)).status, 0);
  EXPECT_EQ(Run({}, rank(3, 4)).status, 0);
  EXPECT_FALSE(std::filesystem::exists(out.Path("out/results.csv")));
  const auto kept = std::filesystem::last_write_time(out.Path("out/chunks/000001.csv"));
  EXPECT_EQ(Run({}, rank(1, 2)).status, 0);
  EXPECT_EQ(std::filesystem::last_write_time(out.Path("out/chunks/000001.csv")), kept);
  EXPECT_EQ(Run({}, rank(0, 2)).status, 0);
  ExpectWholeAndNothingElse();

  // One process alone finishes as well.
  std::filesystem::remove_all(out.Path("out"));
  EXPECT_EQ(Run({}, rank(2, 3)).status, 0);
  EXPECT_EQ(Run({}).status, 0);
  ExpectWholeAndNothingElse();
}

TEST_F(CliBatchShares, AMergeNamesGapsAndTakesNoStranger) {
  EXPECT_EQ(Run({"--task=2/3"}).status, 0);
  const ProgramResult gaps = Run({"--merge"});
  EXPECT_EQ(gaps.status, 3);
  EXPECT_THAT(gaps.err, AllOf(HasSubstr("no results of 16 of 24 tasks"), HasSubstr("chunks 0 2")));
  EXPECT_FALSE(std::filesystem::exists(out.Path("out/results.csv")));

  const std::string chunk = out.Read("out/chunks/000001.csv");
  const auto refused = [this](const std::string& text, const std::string& message) {
    out.Write("out/chunks/000001.csv", text);
    const ProgramResult result = Run({"--merge"});
    EXPECT_EQ(result.status, 3) << message;
    EXPECT_THAT(result.err, AllOf(HasSubstr("out/chunks/000001.csv"), HasSubstr(message)));
  };
  std::string other = chunk;
  refused("# hexcal/chunk/1 s 0123 1\n" + chunk.substr(chunk.find('\n') + 1), "another manifest");
  refused(chunk.substr(0, chunk.size() - 20), "not all of a chunk");
  refused("", "another manifest");
  other.replace(other.find("done,,"), 6, "done,x,");
  refused(other, "another result for row 1");
  other = chunk;
  other.replace(other.find("\ns,1,"), 5, "\ns,1111,");
  refused(other, ":3: found another row");
  other = chunk;
  other.replace(other.find(",n,5,"), 5, ",n,five,");
  refused(other, ":3: found 'five'");

  out.Write("out/chunks/000001.csv", chunk);
  EXPECT_EQ(Run({"--task=1/3"}).status, 0);
  EXPECT_EQ(Run({"--task=3/3"}).status, 0);
  EXPECT_EQ(Run({"--merge"}).status, 0);
  ExpectWholeAndNothingElse();
}

TEST_F(CliBatchShares, RefusesWhatIsNoShare) {
  for (const char* task : {"0/2", "3/2", "1", "1/", "/2", "a/b", "1/2/3", "-1/2", "1/0"})
    EXPECT_EQ(Run({std::string("--task=") + task}).status, 2) << task;
  EXPECT_EQ(Run({"--task=1/2", "--merge"}).status, 2);
  EXPECT_EQ(Run({"--task=1/2", "--force"}).status, 2);
  EXPECT_EQ(Run({"--task=1/2", "--retry"}).status, 2);
  EXPECT_EQ(Run({}, {{"OMPI_COMM_WORLD_RANK", "2"}, {"OMPI_COMM_WORLD_SIZE", "2"}}).status, 2);
  EXPECT_FALSE(std::filesystem::exists(out.Path("out")));
}

// examples/batch/slurm_array.sh as Slurm runs it, tasks in an order of its own, two at a time.
TEST_F(CliBatchShares, AJobArrayGivesTheSameBytes) {
  const std::string path = std::filesystem::path(HEXCAL_PROGRAM).parent_path().string() + ":" +
                           std::string(std::getenv("PATH"));
  const auto task = [&](int id) {
    return RunProgram(std::string(HEXCAL_EXAMPLES) + "/batch/slurm_array.sh",
                      {{data_->Path("m.yaml"), "out"},
                       out.Path(""),
                       {{"PATH", path},
                        {"SLURM_ARRAY_TASK_ID", std::to_string(id)},
                        {"SLURM_ARRAY_TASK_COUNT", "5"},
                        {"SLURM_CPUS_PER_TASK", "2"}}});
  };
  for (const auto& [one, other] : {std::pair{4, 1}, {2, 5}, {3, 3}}) {
    auto at_the_same_time = std::async(std::launch::async, task, one);
    EXPECT_EQ(task(other).status, 0);
    EXPECT_EQ(at_the_same_time.get().status, 0);
  }
  EXPECT_EQ(Run({"--merge"}).status, 0);
  ExpectWholeAndNothingElse();
}

#ifdef HEXCAL_MPIRUN
TEST_F(CliBatchShares, MpirunGivesTheSameBytes) {
  const std::string path = std::filesystem::path(HEXCAL_PROGRAM).parent_path().string() + ":" +
                           std::string(std::getenv("PATH"));
  for (const std::string processes : {"2", "3", "4"}) {
    std::filesystem::remove_all(out.Path("out"));
    const ProgramResult result =
        RunProgram(std::string(HEXCAL_EXAMPLES) + "/batch/mpirun.sh",
                   {{processes, data_->Path("m.yaml"), "out", "--oversubscribe"},
                    out.Path(""),
                    {{"PATH", path},
                     {"OMPI_ALLOW_RUN_AS_ROOT", "1"},
                     {"OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1"}}});
    EXPECT_EQ(result.status, 0) << result.err;
    ExpectWholeAndNothingElse();
  }
}
#endif

}  // namespace
}  // namespace hexcal
