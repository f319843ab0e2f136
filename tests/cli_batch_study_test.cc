// SPDX-License-Identifier: BSD-3-Clause
// A Monte Carlo study from outside: the same bytes however it is cut, whatever kills it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <filesystem>
#include <future>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "config/database.h"
#include "testing/random.h"
#include "testing/run_program.h"
#include "testing/temporary_folder.h"

namespace hexcal {
namespace {

using ::hexcal::testing::ProgramResult;
using ::hexcal::testing::RunHexcal;
using ::hexcal::testing::TemporaryFolder;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;
using ::testing::UnorderedElementsAre;

using Arguments = std::vector<std::string>;

constexpr const char* kDataset = R"(format: hexcal/dataset/1
name: six
units: {length: m, angle: rad}
robot_poses:
  rows:
    - [pose, x, y, z, rx, ry, rz]
    - [a, 0, 0, 0.4, 0, 0, 0]
    - [b, 0.05, 0, 0.4, 0.3, 0, 0]
    - [c, 0, 0.05, 0.42, 0, 0.3, 0]
    - [d, 0.02, 0.01, 0.38, 0, 0, 0.3]
    - [e, -0.05, 0.03, 0.41, -0.2, 0.2, 0.1]
    - [f, 0.01, -0.04, 0.39, 0.1, -0.3, -0.2]
measurement:
  kind: poses
  noise: {position: 0.0001, orientation: 0.001}
)";
constexpr const char* kTruth = R"(format: hexcal/model/1
dataset: six
world_from_base: {xyz: [1, 2, 3], quaternion: [0.5, 0.5, 0.5, 0.5]}
platform_from_tool: {xyz: [0.1, 0.05, 0.2], quaternion: [0.8, 0, 0.6, 0]}
)";

std::string ManifestText(int draws) {
  return "format: hexcal/batch/1\nname: mc\nstudy:\n  draws: " + std::to_string(draws) +
         "\n  scenarios:\n"
         "    - {name: six, dataset: six.yaml, truth: truth.yaml, noise: [1, 2], poses: [5, 6]}\n"
         "estimators: [nonlinear, shah, {name: huber, method: nonlinear, settings: {loss: "
         "huber}}]\n";
}

class CliBatchStudy : public ::testing::Test {
 protected:
  CliBatchStudy() {
    folder.Write("six.yaml", kDataset);
    folder.Write("truth.yaml", kTruth);
    folder.Write("m.yaml", ManifestText(20));
  }

  ProgramResult Run(const Arguments& arguments) const {
    return RunHexcal({arguments, folder.Path("")});
  }

  // Begun in the background; its process id.
  pid_t Start(const Arguments& arguments) const {
    const pid_t child = fork();
    if (child != 0) return child;
    std::vector<char*> argv = {const_cast<char*>(HEXCAL_PROGRAM)};
    for (const std::string& argument : arguments)
      argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);
    if (chdir(folder.Path("").c_str()) == 0) execv(HEXCAL_PROGRAM, argv.data());
    _exit(127);
  }

  std::vector<std::string> NamesIn(const std::string& name) const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder.Path(name)))
      names.push_back(entry.path().filename().string());
    return names;
  }

  // -1 where the next run has first to undo what a killed one had begun.
  std::int64_t StoredRows() const {
    try {
      const DatabaseKind kind = {"hxcb", 1, "results", ""};
      Database database(folder.Path("out/results.sqlite"), kind, Database::Access::kRead);
      Statement check(&database, "PRAGMA integrity_check");
      EXPECT_TRUE(check.Step());
      EXPECT_EQ(check.Text(0), "ok");
      Statement count(&database, "SELECT count(*) FROM results");
      EXPECT_TRUE(count.Step());
      return count.Integer(0);
    } catch (const std::runtime_error&) {
      return -1;
    }
  }

  std::int64_t FinishedChunks() const {
    if (!std::filesystem::exists(folder.Path("out/chunks"))) return 0;
    std::int64_t whole = 0;
    for (const std::string& name : NamesIn("out/chunks")) {
      if (name.find(".csv") == std::string::npos) continue;  // what a kill left, seen by nobody
      const std::string text = folder.Read("out/chunks/" + name);
      EXPECT_EQ(text.substr(text.size() - 6), "# end\n") << name;
      ++whole;
    }
    return whole;
  }

  TemporaryFolder folder;
};

TEST_F(CliBatchStudy, WritesRowsAndASummary) {
  const ProgramResult result = Run({"batch", "m.yaml", "--out=out"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, AllOf(HasSubstr("estimator"), HasSubstr("huber")));
  EXPECT_THAT(NamesIn("out"),
              UnorderedElementsAre("results.csv", "results.sqlite", "run.json", "summary.csv"));
  EXPECT_THAT(folder.Read("out/results.csv"),
              AllOf(StartsWith("study,idx,status,message,scenario,noise,poses,effects,draw,"),
                    HasSubstr("\nmc,239,done,,six,2,6,1,19,huber,1,")));
  const std::string summary = folder.Read("out/summary.csv");
  EXPECT_THAT(summary, AllOf(StartsWith("study,scenario,"), HasSubstr("\nmc,six,2,5,1,shah,20,")));
  EXPECT_EQ(std::count(summary.begin(), summary.end(), '\n'), 1 + 12);
}

TEST_F(CliBatchStudy, GivesTheSameBytesForThreadsRanksAndShares) {
  ASSERT_EQ(Run({"batch", "m.yaml", "--out=one", "--threads=1"}).status, 0);
  const std::string csv = folder.Read("one/results.csv");
  const std::string summary = folder.Read("one/summary.csv");
  const auto expect_the_same = [&](const std::string& name) {
    EXPECT_EQ(folder.Read(name + "/results.csv"), csv) << name;
    EXPECT_EQ(folder.Read(name + "/summary.csv"), summary) << name;
  };
  for (const std::string threads : {"2", "4"}) {
    EXPECT_EQ(Run({"batch", "m.yaml", "--out=t" + threads, "--threads=" + threads}).status, 0);
    expect_the_same("t" + threads);
  }
  for (const int size : {2, 3, 4}) {
    const std::string out = "r" + std::to_string(size);
    std::vector<std::future<ProgramResult>> ranks;
    for (int rank = 0; rank < size; ++rank)
      ranks.push_back(std::async(std::launch::async, [=] {
        return RunHexcal(
            {{"batch", "m.yaml", "--out=" + out},
             folder.Path(""),
             {{"PMI_RANK", std::to_string(rank)}, {"PMI_SIZE", std::to_string(size)}}});
      }));
    for (auto& rank : ranks) EXPECT_EQ(rank.get().status, 0);
    expect_the_same(out);
  }
  for (const std::string task : {"--task=2/2", "--task=1/2", "--merge"})
    EXPECT_EQ(Run({"batch", "m.yaml", "--out=s", task, "--quiet"}).status, 0);
  expect_the_same("s");
}

TEST_F(CliBatchStudy, RunsTheExampleOfFigure5) {
  const ProgramResult result =
      Run({"batch", std::string(HEXCAL_EXAMPLES) + "/batch/figure5.yaml", "--out=out"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(folder.Read("out/summary.csv"),
              AllOf(HasSubstr("\nfigure5,neurobot,1,5,1,nonlinear,"),
                    HasSubstr("\nfigure5,neurobot,1,60,1,paper,40,0,0,")));
}

// Killed at any moment, alone or as a share: no half-written file, nothing finished is lost, and
// the end is as if nothing had happened. scripts/kill_batch does so a thousand times.
TEST_F(CliBatchStudy, SurvivesKills) {
  folder.Write("m.yaml", ManifestText(60));
  ASSERT_EQ(Run({"batch", "m.yaml", "--out=whole", "--quiet"}).status, 0);
  const std::string csv = folder.Read("whole/results.csv");
  auto rng = testing::SeededByTest();
  int kills = 0, killed_at_work = 0;
  std::int64_t stored = 0;
  for (int round = 0; kills < 100; ++round) {
    std::filesystem::remove_all(folder.Path("out"));
    stored = 0;
    const bool as_shares = round % 2 == 1;
    for (bool done = false; !done && kills < 1000;) {
      std::vector<pid_t> children;
      for (int k = 1; k <= (as_shares ? 2 : 1); ++k) {
        Arguments arguments = {"batch", "m.yaml", "--out=out", "--quiet"};
        if (as_shares) arguments.push_back("--task=" + std::to_string(k) + "/2");
        children.push_back(Start(arguments));
      }
      std::this_thread::sleep_for(
          std::chrono::microseconds(static_cast<int>(testing::Uniform(rng, 0.0, 80'000.0))));
      done = true;
      for (const pid_t child : children) {
        kill(child, SIGKILL);
        int status = 0;
        ASSERT_EQ(waitpid(child, &status, 0), child);
        ASSERT_TRUE(WIFSIGNALED(status) || WEXITSTATUS(status) == 0);
        ++kills;
        done = done && !WIFSIGNALED(status);
        killed_at_work += WIFSIGNALED(status) ? 1 : 0;
      }
      const std::int64_t finished = as_shares ? FinishedChunks() : StoredRows();
      EXPECT_TRUE(finished < 0 || finished >= stored) << finished << " of " << stored;
      stored = std::max(stored, finished);
      if (std::filesystem::exists(folder.Path("out/results.csv"))) {
        EXPECT_EQ(folder.Read("out/results.csv"), csv);
      }
    }
    if (as_shares) {
      EXPECT_EQ(Run({"batch", "m.yaml", "--out=out", "--merge", "--quiet"}).status, 0);
    }
    EXPECT_EQ(Run({"batch", "m.yaml", "--out=out", "--quiet"}).status, 0);
    EXPECT_EQ(folder.Read("out/results.csv"), csv);
    EXPECT_THAT(NamesIn("out"),
                UnorderedElementsAre("results.csv", "results.sqlite", "run.json", "summary.csv"));
  }
  EXPECT_GE(killed_at_work, 50);
}

// Wherever there is no more room: exit status 5, an earlier result as it was, nothing half written;
// with room again, the end is as if nothing had happened.
TEST_F(CliBatchStudy, SaysWhereThereIsNoRoom) {
  const auto run_with_room = [this](int kibibytes, const std::string& out) {
    return testing::RunProgram("/bin/bash",
                               {{"-c",
                                 "ulimit -f " + std::to_string(kibibytes) + " && exec " +
                                     HEXCAL_PROGRAM + " batch m.yaml --quiet --out=" + out},
                                folder.Path("")});
  };
  ASSERT_EQ(Run({"batch", "m.yaml", "--out=whole", "--quiet"}).status, 0);
  const std::string csv = folder.Read("whole/results.csv");
  bool was_refused = false, was_done = false;
  for (const int kibibytes : {0, 4, 20, 80, 160, 400}) {
    const std::string out = "out" + std::to_string(kibibytes);
    const ProgramResult result = run_with_room(kibibytes, out);
    EXPECT_THAT(result.status, ::testing::AnyOf(0, 5)) << kibibytes << ": " << result.err;
    was_done = was_done || result.status == 0;
    if (result.status == 5) {
      was_refused = true;
      if (kibibytes > 0) {  // else the message has no room either
        EXPECT_THAT(result.err, StartsWith("hexcal: " + out + "/"));
      }
      EXPECT_FALSE(std::filesystem::exists(folder.Path(out + "/results.csv")));
      EXPECT_EQ(Run({"batch", "m.yaml", "--quiet", "--out=" + out}).status, 0);
    }
    EXPECT_TRUE(folder.Read(out + "/results.csv") == csv) << kibibytes;
    EXPECT_THAT(NamesIn(out),
                UnorderedElementsAre("results.csv", "results.sqlite", "run.json", "summary.csv"));
  }
  EXPECT_TRUE(was_refused && was_done);
  // An earlier result stays.
  folder.Write("m.yaml", ManifestText(21));
  EXPECT_EQ(run_with_room(20, "whole --force").status, 5);
  EXPECT_TRUE(folder.Read("whole/results.csv") == csv);
}

TEST_F(CliBatchStudy, AnInterruptKeepsWhatWasFinished) {
  folder.Write("m.yaml", ManifestText(2000));
  const pid_t child = Start({"batch", "m.yaml", "--out=out", "--quiet", "--threads=2"});
  const auto stored = [this] {
    std::error_code ignored;
    const auto size = std::filesystem::file_size(folder.Path("out/results.sqlite"), ignored);
    return ignored ? 0 : static_cast<int>(size);
  };
  while (stored() < 100'000) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  kill(child, SIGINT);
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 130);
  EXPECT_GE(stored(), 100'000);
  EXPECT_FALSE(std::filesystem::exists(folder.Path("out/results.csv")));
}

TEST_F(CliBatchStudy, IsAnotherWhereAFileThatItNamesHasChanged) {
  EXPECT_EQ(Run({"batch", "m.yaml", "--out=out"}).status, 0);
  std::string moved = kTruth;
  moved.replace(moved.find("[1, 2, 3]"), 9, "[1, 2, 4]");
  folder.Write("truth.yaml", moved);
  EXPECT_EQ(Run({"batch", "m.yaml", "--out=out"}).status, 3);
}

TEST_F(CliBatchStudy, RefusesABadStudyWithItsLine) {
  const std::string head = "format: hexcal/batch/1\nname: x\n";
  const std::string good = "  scenarios: [{name: s, dataset: six.yaml, truth: truth.yaml}]\n";
  const std::string by = "estimators: [nonlinear]\n";
  const auto expect = [this](const std::string& text, const std::string& message) {
    folder.Write("bad.yaml", text);
    const ProgramResult result = Run({"batch", "bad.yaml", "--out=out"});
    EXPECT_EQ(result.status, 3) << text;
    EXPECT_THAT(result.err, HasSubstr("bad.yaml:" + message)) << text;
    EXPECT_FALSE(std::filesystem::exists(folder.Path("out")));
  };
  const auto scenario = [&](const std::string& more) {
    return head + "study:\n  draws: 5\n  scenarios:\n" +
           "    - {name: s, dataset: six.yaml, truth: truth.yaml, " + more + "}\n" + by;
  };
  expect(head + "study:\n  draws: 0\n" + good + by, "4:10: found 0, expected a whole number");
  expect(head + "study:\n  draws: 5\n  seed: -1\n" + good + by, "5:9: found -1");
  expect(head + "study:\n  draws: 5\n" + good, "1:1: found");
  expect(head + "study:\n  draws: 5\n" + good + by + "datasets: [six.yaml]\n",
         "7:11: found datasets beside a study");
  expect(head + "study:\n  draws: 5\n" + good + "estimators: [best]\n",
         "6:14: found the method 'best'");
  expect(head + "study:\n  draws: 5\n" + good + "estimators: [shah, shah]\n",
         "6:20: found the name 'shah' again");
  expect(head + "study:\n  draws: 5\n" + good + "estimators: [marker]\n",
         "6:13: found the method marker");
  expect(head + "study:\n  draws: 5\n" + good +
             "estimators: [{method: nonlinear, settings: {los: huber}}]\n",
         "6:45: found");
  expect(head + "study:\n  draws: 5\n  scenarios: []\n" + by, "5:14: found no scenario");
  expect(scenario("poses: 7"), "6:62: found 7, expected a whole number from 3 to 6");
  expect(scenario("noise: [1, -1]"), "6:66: found -1");
  expect(scenario("effects: []"), "6:64: found an empty list");
  expect(scenario("colour: red"), "6:55: found the unknown key 'colour'");
}

}  // namespace
}  // namespace hexcal
