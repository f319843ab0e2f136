// SPDX-License-Identifier: BSD-3-Clause
// hexcal pivot from files to pivot.json, with the bundled example and with files gone wrong.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "config/strict_yaml.h"
#include "testing/run_program.h"
#include "testing/temporary_folder.h"

namespace hexcal {
namespace {

using ::hexcal::testing::ProgramResult;
using ::hexcal::testing::RunHexcal;
using ::hexcal::testing::TemporaryFolder;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using Json = nlohmann::json;

const std::string kExample = std::string(HEXCAL_EXAMPLES) + "/pivot";

Json ReadJson(const std::string& path) {
  std::ifstream file(path);
  return Json::parse(file);
}

// What the example was simulated with, m.
std::vector<double> Truth(const std::string& key) {
  const YamlNode root = ParseYamlFile(kExample + "/truth.yaml");
  for (const auto& [name, value] : root.entries)
    if (name.scalar == key) {
      std::vector<double> xyz = ReadNumbers(value, 3, "a point");
      for (double& x : xyz) x *= 1e-3;
      return xyz;
    }
  return {};
}

void ExpectTruth(const Json& point, const std::vector<double>& truth) {
  for (std::size_t k = 0; k < 3; ++k) {
    const double sigma = point["standard_deviation"][k];
    EXPECT_NEAR(point["xyz"][k].get<double>(), truth.at(k), 3.0 * sigma);
    EXPECT_GT(sigma, 1e-6);
    EXPECT_LT(sigma, 1e-4);
  }
}

TEST(CliPivot, FindsTheTipOfTheExampleAndThePoseThatSlipped) {
  const TemporaryFolder folder;
  const ProgramResult run = RunHexcal(
      {{"pivot", kExample + "/pivoting.yaml", "--out=" + folder.Path(""), "--outliers=reject"}});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("tool tip from 39 poses, 1 left out"));
  EXPECT_THAT(run.err, HasSubstr("pose 17 (line 51) is left out as an outlier"));
  const Json json = ReadJson(folder.Path("tool-tip/pivot.json"));
  EXPECT_EQ(json["format"], "hexcal/pivot/1");
  EXPECT_EQ(json["trustworthy"], true);
  ExpectTruth(json["tip"], Truth("tip"));
  ExpectTruth(json["pivot"], Truth("pivot"));
  ASSERT_EQ(json["outliers"].size(), 1u);
  EXPECT_EQ(json["outliers"][0]["pose"], "17");
  EXPECT_EQ(json["outliers"][0]["line"], 51);
  EXPECT_NEAR(json["outliers"][0]["distance"].get<double>(), 1.32e-3, 0.2e-3);
  EXPECT_EQ(json["poses"][16]["used"], false);
  EXPECT_LT(json["chi_square"]["value"], json["chi_square"]["high"]);
  EXPECT_GT(json["chi_square"]["value"], json["chi_square"]["low"]);
  const Json record = ReadJson(folder.Path("tool-tip/run.json"));
  EXPECT_EQ(record["inputs"].size(), 2u);
}

TEST(CliPivot, WritesAReportOnlyWhereAskedTo) {
  const TemporaryFolder folder;
  const std::string out = "--out=" + folder.Path("");
  ASSERT_EQ(RunHexcal({{"pivot", kExample + "/pivoting.yaml", out, "--quiet"}}).status, 0);
  EXPECT_FALSE(std::ifstream(folder.Path("tool-tip/report.html")).good());
  const ProgramResult run =
      RunHexcal({{"pivot", kExample + "/pivoting.yaml", out, "--quiet", "--report"}});
  ASSERT_EQ(run.status, 0) << run.err;
  const std::string html = folder.Read("tool-tip/report.html");
  EXPECT_THAT(html, HasSubstr("<!-- hexcal/report/pivot/1 -->"));
  EXPECT_THAT(html, HasSubstr("<strong>determined, but doubtful</strong>"));  // a reading slipped
  EXPECT_THAT(html, HasSubstr("hexcal pivot "));
}

TEST(CliPivot, TwoRunsWriteTheSameBytesAndJsonIsOneLine) {
  const TemporaryFolder folder;
  const std::vector<std::string> arguments = {
      "pivot", kExample + "/pivoting.yaml", "--out=" + folder.Path(""), "--json"};
  const ProgramResult a = RunHexcal({arguments});
  const std::string first = folder.Read("tool-tip/pivot.json");
  const ProgramResult b = RunHexcal({arguments});
  EXPECT_EQ(a.out, b.out);
  EXPECT_EQ(first, folder.Read("tool-tip/pivot.json"));
  EXPECT_EQ(Json::parse(a.out), Json::parse(first));
  EXPECT_EQ(std::count(a.out.begin(), a.out.end(), '\n'), 1);
}

// A tip at (0, 0, 5) mm and a divot at (1, 2, 3) mm, by hand; quarter turns and a half one.
constexpr const char* kTable =
    "pose,x,y,z,rx,ry,rz\n"
    "a,1,2,-2,0,0,0\n"
    "b,1,7,3,90,0,0\n"
    "c,-4,2,3,0,90,0\n"
    "d,1,2,8,180,0,0\n";

ProgramResult RunOn(const TemporaryFolder& folder,
                    const std::string& file,
                    const std::vector<std::string>& more) {
  std::vector<std::string> arguments = {"pivot", file, "--out=out"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return RunHexcal({arguments, folder.Path("")});
}

TEST(CliPivot, ReadsATableOfPoses) {
  const TemporaryFolder folder;
  folder.Write("probe.csv", kTable);
  const ProgramResult run =
      RunOn(folder,
            "probe.csv",
            {"--units=mm,deg", "--noise_position=0.0001", "--noise_orientation=0.0001"});
  ASSERT_EQ(run.status, 0) << run.err;
  const Json json = ReadJson(folder.Path("out/probe/pivot.json"));
  const std::vector<double> tip = {0, 0, 0.005}, pivot = {0.001, 0.002, 0.003};
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(json["tip"]["xyz"][k].get<double>(), tip[k], 1e-12);
    EXPECT_NEAR(json["pivot"]["xyz"][k].get<double>(), pivot[k], 1e-12);
  }
  EXPECT_EQ(json["noise"]["from"], "stated");
}

TEST(CliPivot, YamlAndTableGiveTheSame) {
  const TemporaryFolder folder;
  folder.Write("probe.csv", kTable);
  folder.Write("probe.yaml",
               "format: hexcal/pivoting/1\nname: probe\nunits: {length: mm, angle: deg}\n"
               "measurement: {kind: poses, file: probe.csv}\n");
  ASSERT_EQ(RunOn(folder, "probe.csv", {"--units=mm,deg"}).status, 0);
  const std::string from_table = folder.Read("out/probe/pivot.json");
  ASSERT_EQ(RunOn(folder, "probe.yaml", {}).status, 0);
  EXPECT_EQ(folder.Read("out/probe/pivot.json"), from_table);
}

TEST(CliPivot, TurnsAboutOneAxisExitWith4AndSayWhatIsLost) {
  const TemporaryFolder folder;
  folder.Write("probe.csv",
               "pose,x,y,z,rx,ry,rz\na,-1,0,-5,0,0,0\nb,0,-1,-5,0,0,90\nc,1,0,-5,0,0,180\n"
               "d,0,1,-5,0,0,270\n");
  const ProgramResult run = RunOn(folder, "probe.csv", {"--units=mm,deg"});
  EXPECT_EQ(run.status, 4);
  EXPECT_THAT(run.err, HasSubstr("not determined along (0.000, 0.000, 1.000) of frame T"));
  EXPECT_THAT(run.out, HasSubstr("undetermined"));
  const Json tip = ReadJson(folder.Path("out/probe/pivot.json"))["tip"];
  EXPECT_NEAR(tip["xyz"][0].get<double>(), 0.001, 1e-12);
  EXPECT_NEAR(tip["xyz"][1].get<double>(), 0.0, 1e-12);
  EXPECT_TRUE(tip["standard_deviation"][0].is_number());
  EXPECT_TRUE(tip["standard_deviation"][2].is_null());
  EXPECT_TRUE(tip["covariance"][0][2].is_null());
}

// A mistake, and where the message must say it is.
struct Mistake {
  std::string file;
  std::string content;
  std::string message;
};

TEST(CliPivot, RefusesBadFilesWithThePlace) {
  const std::string head =
      "format: hexcal/pivoting/1\nname: probe\nunits: {length: mm, angle: deg}\n";
  const std::vector<Mistake> mistakes = {
      {"p.csv", "pose,x,y,z,rx,ry,rz\n1,0,0,0,0,0,0\n2,0,0,0,1,0,0\n", "2 poses"},
      {"p.csv", "pose,x,y,z,rx,ry\n1,0,0,0,0,0\n", "p.csv:1"},
      {"p.csv", "x,y,z,rx,ry,rz\n0,0,0,0,0,0\n", "no column 'pose'"},
      {"p.csv", "pose,x,y,z,rx,ry,rz\n1,0,0,0,0,0,oops\n", "p.csv:2:13: found"},
      {"p.csv",
       "pose,x,y,z,rx,ry,rz\n1,0,0,0,0,0,0\n1,0,0,0,1,0,0\n",
       "p.csv:3:1: found the pose '1' a second time"},
      {"p.csv", "pose,x,y,z,qw,qx,qy,qz\n1,0,0,0,2,0,0,0\n", "p.csv:2"},
      {"p.yaml", "format: hexcal/dataset/1\n", "p.yaml:1:9: found the format"},
      {"p.yaml", head + "robot_poses: {}\n", "p.yaml:4:1: found the unknown key 'robot_poses'"},
      {"p.yaml", head, "'measurement'"},
      {"p.yaml", head + "measurement: {kind: poses, file: none.csv}\n", "no file 'none.csv'"},
      {"p.yaml", head + "measurement: {kind: poses, file: ../p.csv}\n", "leaves"},
      {"p.yaml",
       head + "tracker: {static: maybe}\nmeasurement: {kind: poses, rows: [[pose]]}\n",
       "p.yaml:4:19"},
      {"p.yaml",
       head + "measurement: {kind: poses, rows: [[pose, x, y, z, rx, ry, rz]], "
              "noise: {position: -1, orientation: 1}}\n",
       "above zero"},
      {"p.yaml",
       head + "measurement:\n  kind: markers\n  rows: [[pose, body, marker, x, y, z], "
              "[1, base, b1, 0, 0, 0]]\n  bodies: {tool: {frame: rigid, markers: {a: [0, 0, 0], "
              "b: [1, 0, 0], c: [0, 1, 0]}}}\n",
       "b1"},
  };
  for (const Mistake& mistake : mistakes) {
    const TemporaryFolder folder;
    folder.Write(mistake.file, mistake.content);
    const bool is_table = mistake.file == "p.csv";
    const ProgramResult run =
        RunOn(folder,
              mistake.file,
              is_table ? std::vector<std::string>{"--units=mm,deg"} : std::vector<std::string>{});
    EXPECT_EQ(run.status, 3) << mistake.content;
    EXPECT_THAT(run.err, HasSubstr(mistake.message));
    EXPECT_THAT(run.err, HasSubstr(mistake.file)) << mistake.content;
    EXPECT_FALSE(std::filesystem::exists(folder.Path("out")));
  }
}

TEST(CliPivot, WrongUsage) {
  const TemporaryFolder folder;
  folder.Write("probe.csv", kTable);
  folder.Write("a b.csv", kTable);
  const ProgramResult no_units = RunOn(folder, "probe.csv", {});
  EXPECT_EQ(no_units.status, 2);
  EXPECT_THAT(no_units.err, HasSubstr("--units=LENGTH,ANGLE is missing"));
  EXPECT_EQ(RunOn(folder, "probe.csv", {"--units=inch,deg"}).status, 2);
  EXPECT_EQ(RunOn(folder, "a b.csv", {"--units=mm,deg"}).status, 2);
  EXPECT_EQ(RunOn(folder, "a b.csv", {"--units=mm,deg", "--name=ab"}).status, 0);
  EXPECT_EQ(RunHexcal({{"pivot", kExample + "/pivoting.yaml", "--units=mm,deg", "--out=o"},
                       folder.Path("")})
                .status,
            2);
}

TEST(CliPivot, LeavesForeignFilesAlone) {
  const TemporaryFolder folder;
  folder.Write("probe.csv", kTable);
  std::filesystem::create_directories(folder.Path("out/probe"));
  folder.Write("out/probe/pivot.json", "mine");
  EXPECT_EQ(RunOn(folder, "probe.csv", {"--units=mm,deg"}).status, 5);
  EXPECT_EQ(folder.Read("out/probe/pivot.json"), "mine");
  EXPECT_EQ(RunOn(folder, "probe.csv", {"--units=mm,deg", "--force"}).status, 0);
}

// The tip goes into the audit of the machine that carries the tool.
TEST(CliPivot, FeedsTheTipIntoTheAudit) {
  const TemporaryFolder folder;
  ASSERT_EQ(
      RunHexcal(
          {{"pivot", kExample + "/pivoting.yaml", "--out=" + folder.Path(""), "--outliers=reject"}})
          .status,
      0);
  folder.Write("pivot.json", folder.Read("tool-tip/pivot.json"));
  folder.Write("requirement.yaml",
               "format: hexcal/requirement/1\nunits: {length: mm, angle: deg}\n"
               "points: [{name: tip, pivot: pivot.json}]\n"
               "robot: {position: 0.005, orientation: 0.002, from: assumed}\n"
               "requirements: [{name: drilling, point: tip, over: poses, limit: 0.5}]\n");
  const ProgramResult run = RunHexcal({{"audit",
                                        std::string(HEXCAL_EXAMPLES) + "/neurobot/dataset.yaml",
                                        "--requirement=" + folder.Path("requirement.yaml"),
                                        "--out=" + folder.Path(""),
                                        "--draws=4000"}});
  ASSERT_EQ(run.status, 0) << run.err;
  const Json audit = ReadJson(folder.Path("neurobot/audit.json"));
  const Json tip = ReadJson(folder.Path("pivot.json"))["tip"];
  const Json& point = audit["points"][0];
  EXPECT_EQ(point["xyz"], tip["xyz"]);
  EXPECT_EQ(point["pivot"]["covariance"], tip["covariance"]);
  const Json& row = point["budget"].back();
  EXPECT_EQ(row["source"], "the point in frame T");
  EXPECT_EQ(row["from"], "pivoting, pivot.json");
  EXPECT_EQ(row["type"], "B");
  double trace = 0.0;
  for (std::size_t k = 0; k < 3; ++k) trace += tip["covariance"][k][k].get<double>();
  EXPECT_NEAR(row["rms"].get<double>(), std::sqrt(trace), 1e-12);
  EXPECT_NEAR(row["value"].get<double>(), std::sqrt(trace / 3.0), 1e-12);  // of each coordinate
  const Json& repeated = point["monte_carlo"];
  EXPECT_NEAR(repeated["repeated_rms"].get<double>() / repeated["rms"].get<double>(), 1.0, 0.03);
  EXPECT_EQ(audit["inputs"].back()["file"], folder.Path("pivot.json"));
  EXPECT_THAT(folder.Read("neurobot/report.html"), HasSubstr("(pivoting)"));
}

}  // namespace
}  // namespace hexcal
