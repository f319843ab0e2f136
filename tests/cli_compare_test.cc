// SPDX-License-Identifier: BSD-3-Clause
// hexcal compare from outside. What the numbers ought to be is tested with the estimators.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "testing/cli_test.h"

namespace hexcal {
namespace {

using ::hexcal::testing::ProgramResult;
using ::testing::ContainsRegex;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using Json = nlohmann::json;

constexpr const char* kModel = R"(format: hexcal/model/1
dataset: demo
world_from_base: {xyz: [0.1, 0.2, 0.3], quaternion: [0.995, 0.0999, 0, 0]}
platform_from_tool: {xyz: [0.1, 0.05, 0.2], quaternion: [0.995, 0, 0.0999, 0]}
)";
constexpr const char* kRows = R"(    - [a, 0, 0, 0.4, 0, 0, 0]
    - [b, 0.05, 0, 0.4, 0.3, 0, 0]
    - [c, 0, 0.05, 0.42, 0, 0.3, 0]
    - [d, 0.02, 0.01, 0.38, 0, 0, 0.3]
    - [e, -0.05, 0.03, 0.41, -0.2, 0.2, 0.1]
    - [f, 0.01, -0.04, 0.39, 0.1, -0.3, -0.2]
    - [g, 0.03, -0.02, 0.4, 0.2, 0.1, -0.2]
)";
constexpr const char* kOneAxisRows = R"(    - [a, 0, 0, 0.4, 0, 0, 0]
    - [b, 0.05, 0, 0.4, 0, 0, 0.3]
    - [c, 0, 0.05, 0.42, 0, 0, -0.2]
    - [d, 0.02, 0.01, 0.38, 0, 0, 0.2]
)";

class CliCompare : public testing::CliTest {
 protected:
  CliCompare() { folder.Write("m.yaml", kModel); }

  void Make(const std::string& rows) {
    folder.Write("d.yaml",
                 "format: hexcal/dataset/1\nname: demo\nunits: {length: m, angle: rad}\n"
                 "robot_poses:\n  rows:\n    - [pose, x, y, z, rx, ry, rz]\n" +
                     rows +
                     "measurement:\n  kind: poses\n  rows:\n    - [pose, x, y, z, rx, ry, rz]\n" +
                     rows + "  noise: {position: 0.0001, orientation: 0.001}\n");
    const ProgramResult made =
        Call({"simulate", "d.yaml", "--model=m.yaml", "--out=data", "--quiet"});
    ASSERT_EQ(made.status, 0) << made.err;
  }

  ProgramResult Compare(const std::vector<std::string>& more) const {
    return Call({"compare", "data/demo/dataset.yaml", "--out=out", "--draws=1000", "--starts=2"},
                more);
  }

  Json Read(const std::string& name) const { return Json::parse(folder.Read("out/demo/" + name)); }
};

TEST_F(CliCompare, SetsAllMethodsSideBySide) {
  Make(kRows);
  const ProgramResult result = Compare({});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.err, IsEmpty());
  for (const char* text : {"paper's iteration",
                           "twist iteration",
                           "Zhuang",
                           "Shah",
                           "Li",
                           "Park-Martin",
                           "nonlinear",
                           "proven",
                           "JCGM 101",
                           "held out, 5 folds"})
    EXPECT_THAT(result.out, HasSubstr(text));

  const Json compare = Read("compare.json");
  EXPECT_EQ(compare["format"], "hexcal/compare/1");
  EXPECT_EQ(compare["poses"], 7);
  std::vector<std::string> names;
  for (const Json& method : compare["methods"]) {
    names.push_back(method["name"]);
    EXPECT_EQ(method["difference"].size(), 12u);
    EXPECT_TRUE(method["held_out"]["position"].is_number());
    EXPECT_EQ(method["world_from_base"]["quaternion"].size(), 4u);
  }
  EXPECT_THAT(
      names,
      ElementsAre("paper", "twist", "zhuang", "shah", "li", "park_martin", "nonlinear", "robust"));
  EXPECT_EQ(compare["certificate"]["certified"], true);
  EXPECT_EQ(compare["propagation"]["intervals"].size(), 12u);
  EXPECT_EQ(compare["propagation"]["intervals"][11]["parameter"], "tool.rz");
  EXPECT_EQ(compare["convergence"][1]["method"], "twist");
  EXPECT_EQ(compare["convergence"][1]["share"].size(),
            compare["convergence"][1]["rotation_errors"].size());

  const Json run = Read("run.json");
  EXPECT_EQ(run["methods"].size(), 8u);
  EXPECT_GT(run["methods"][0]["seconds_per_iteration"], 0.0);
  EXPECT_TRUE(run["methods"][3]["seconds_per_iteration"].is_null());
  EXPECT_EQ(run["settings"]["draws"], "1000");
}

TEST_F(CliCompare, WritesTheSameBytesWhateverTheThreadsAndNoTimes) {
  Make(kRows);
  ASSERT_EQ(Compare({"--threads=1"}).status, 0);
  const std::string one = folder.Read("out/demo/compare.json");
  ASSERT_EQ(Compare({"--threads=3"}).status, 0);
  EXPECT_EQ(folder.Read("out/demo/compare.json"), one);
  EXPECT_THAT(one, Not(HasSubstr("seconds")));
  ASSERT_EQ(Compare({"--seed=2"}).status, 0);
  EXPECT_NE(folder.Read("out/demo/compare.json"), one);
}

TEST_F(CliCompare, AReportIsWrittenWhereItIsAskedFor) {
  Make(kRows);
  ASSERT_EQ(Compare({"--report"}).status, 0);
  const std::string once = folder.Read("out/demo/report.html");
  EXPECT_THAT(once, HasSubstr("id=\"verdict\"><strong>certified</strong>"));
  EXPECT_THAT(once, HasSubstr("From which starts the iterations arrive"));
  Make(kOneAxisRows);
  EXPECT_EQ(Compare({"--report"}).status, 4);
  EXPECT_THAT(folder.Read("out/demo/report.html"), HasSubstr("<strong>not certified</strong>"));
}

// Without noise, too, a held-out error is a number and not 0.0000.
TEST_F(CliCompare, AReportOfDataWithoutNoiseCanBeRead) {
  const std::string dataset = std::string(HEXCAL_EXAMPLES) + "/paper/dataset.yaml";
  ASSERT_EQ(Call({"compare", dataset, "--out=out", "--starts=0", "--report"}).status, 0);
  const std::string page = folder.Read("out/paper/report.html");
  EXPECT_THAT(page, Not(HasSubstr(">0.0000<")));
  EXPECT_THAT(page,
              ContainsRegex("<td>Li</td><td class=\"number\">[^<]*</td>"
                            "<td class=\"number\">[0-9.]+e-[0-9]+</td>"));
}

TEST_F(CliCompare, PrintsTheSameAsJsonOrNothing) {
  Make(kRows);
  const ProgramResult json = Compare({"--json"});
  EXPECT_EQ(Json::parse(json.out), Read("compare.json"));
  const ProgramResult quiet = Call(
      {"compare", "data/demo/dataset.yaml", "--out=out", "--draws=1000", "--starts=0", "--quiet"});
  EXPECT_THAT(quiet.out, IsEmpty());
  EXPECT_EQ(Read("compare.json")["convergence"][0]["share"].size(), 0u);
}

TEST_F(CliCompare, TellsByItsStatusThatTheDataLeaveADirectionOpen) {
  Make(kOneAxisRows);
  const ProgramResult result = Compare({});
  EXPECT_EQ(result.status, 4);
  EXPECT_THAT(result.out, HasSubstr("not proven: there is more than one best solution"));
  const Json compare = Read("compare.json");
  EXPECT_EQ(compare["certificate"]["certified"], false);
  EXPECT_EQ(compare["propagation"]["done"], false);
  EXPECT_TRUE(compare["standard_deviation"][2].is_null());
  EXPECT_TRUE(compare["methods"][3]["difference"][2].is_null());
}

TEST_F(CliCompare, TakesTheFlagsOfItsOwnAndOfTheIterations) {
  Make(kRows);
  ASSERT_EQ(Compare({"--iterations=3", "--tolerance=1e-15", "--folds=2"}).status, 0);
  const Json compare = Read("compare.json");
  EXPECT_EQ(compare["methods"][0]["iterations"].size(), 4u);
  EXPECT_EQ(compare["methods"][0]["converged"], false);
  EXPECT_EQ(compare["folds"], 2);
  EXPECT_EQ(Compare({"--folds=1"}).status, 2);
  EXPECT_EQ(Compare({"--solver=linearized"}).status, 2);
  EXPECT_EQ(Call({"compare", "--out=out"}).status, 2);
  const ProgramResult initial = Compare({"--start=initial"});
  EXPECT_EQ(initial.status, 3);
  EXPECT_THAT(initial.err, HasSubstr("no key 'initial'"));
}

TEST_F(CliCompare, SolvesByMarkerToo) {
  const ProgramResult result = Call({"compare",
                                     std::string(HEXCAL_EXAMPLES) + "/neurobot/dataset.yaml",
                                     "--out=out",
                                     "--draws=1000",
                                     "--starts=0"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("by marker"));
  const Json compare = Json::parse(folder.Read("out/neurobot/compare.json"));
  const Json& marker = compare["methods"][7];
  EXPECT_EQ(marker["name"], "marker");
  EXPECT_TRUE(marker["held_out"]["position"].is_number());
  double most = 0.0;
  for (const double sigmas : marker["difference"]) most = std::max(most, std::abs(sigmas));
  EXPECT_LT(most, 0.2);  // rigid bodies: the poses keep nearly all that the readings say
  EXPECT_GT(most, 0.0);
}

}  // namespace
}  // namespace hexcal
