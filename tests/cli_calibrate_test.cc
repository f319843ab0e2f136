// SPDX-License-Identifier: BSD-3-Clause
// hexcal calibrate from outside: the way from a simulated dataset to result.json and model.yaml.
// What the numbers ought to be is tested with the estimators.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "model/machine.h"
#include "testing/cli_test.h"
#include "testing/matchers.h"

namespace hexcal {
namespace {

using ::hexcal::testing::PoseNear;
using ::hexcal::testing::ProgramResult;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::UnorderedElementsAre;

using ::hexcal::testing::Arguments;

constexpr const char* kModel = R"(format: hexcal/model/1
dataset: demo
world_from_base: {xyz: [1, 2, 3], quaternion: [0.5, 0.5, 0.5, 0.5]}
platform_from_tool: {xyz: [0.1, 0.05, 0.2], quaternion: [0.8, 0, 0.6, 0]}
)";

// Poses of the robot; only those that turn about several axes determine base and tool.
constexpr const char* kGoodRows = R"(    - [a, 0, 0, 0.4, 0, 0, 0]
    - [b, 0.05, 0, 0.4, 0.3, 0, 0]
    - [c, 0, 0.05, 0.42, 0, 0.3, 0]
    - [d, 0.02, 0.01, 0.38, 0, 0, 0.3]
    - [e, -0.05, 0.03, 0.41, -0.2, 0.2, 0.1]
    - [f, 0.01, -0.04, 0.39, 0.1, -0.3, -0.2]
)";
constexpr const char* kOneAxisRows = R"(    - [a, 0, 0, 0.4, 0, 0, 0]
    - [b, 0.05, 0, 0.4, 0, 0, 0.3]
    - [c, 0, 0.05, 0.42, 0, 0, -0.2]
    - [d, 0.02, 0.01, 0.38, 0, 0, 0.2]
    - [e, -0.05, 0.03, 0.41, 0, 0, 0.1]
    - [f, 0.01, -0.04, 0.39, 0, 0, -0.3]
)";

std::string DatasetText(const std::string& name, const std::string& rows) {
  return "format: hexcal/dataset/1\nname: " + name +
         "\nunits: {length: m, angle: rad}\nrobot_poses:\n  rows:\n"
         "    - [pose, x, y, z, rx, ry, rz]\n" +
         rows + "measurement:\n  kind: poses\n  rows:\n    - [pose, x, y, z, rx, ry, rz]\n" + rows +
         "  noise: {position: 0.0001, orientation: 0.001}\n";
}

class CliCalibrate : public testing::CliTest {
 protected:
  CliCalibrate() {
    folder.Write("m.yaml", kModel);
    Make("good", kGoodRows);
  }

  // A dataset as the machine of m.yaml would be measured: data/NAME/dataset.yaml.
  void Make(const std::string& name, const std::string& rows, const std::string& noise = "1") {
    folder.Write("d.yaml", DatasetText(name, rows));
    const ProgramResult result =
        Call({"simulate", "d.yaml", "--model=m.yaml", "--out=data", "--quiet", "--noise=" + noise});
    ASSERT_EQ(result.status, 0) << result.err;
  }

  ProgramResult Calibrate(const Arguments& more = {}, const std::string& name = "good") const {
    return Call({"calibrate", "data/" + name + "/dataset.yaml"}, more);
  }

  std::string Result(const std::string& where) const { return folder.Read(where + "/result.json"); }
};

TEST_F(CliCalibrate, RecoversTheMachineThatWasSimulated) {
  Make("exact", kGoodRows, "0");
  const ProgramResult result = Calibrate({"--out=out"}, "exact");
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("mrad"));
  const Machine truth = ReadMachine(folder.Path("m.yaml"));
  const Machine found = ReadMachine(folder.Path("out/exact/model.yaml"));
  EXPECT_TRUE(PoseNear(found.world_from_base, truth.world_from_base, 1e-9, 1e-9));
  EXPECT_TRUE(PoseNear(found.platform_from_tool, truth.platform_from_tool, 1e-9, 1e-9));
}

TEST_F(CliCalibrate, TheModelGoesBackIn) {
  EXPECT_EQ(Calibrate({"--out=out"}).status, 0);
  const Arguments predict = {
      "predict", "data/good/dataset.yaml", "--model=out/good/model.yaml", "--out=p.csv"};
  EXPECT_EQ(Call(predict).status, 0);
}

TEST_F(CliCalibrate, RefitsTheEffectsOfAModel) {
  const std::string effect = "effects:\n  - {name: tracker_scale, parameters: {scale: ";
  folder.Write("m.yaml", std::string(kModel) + effect + "0.0005}}\n");
  std::string text = DatasetText("scaled", kGoodRows);
  const std::string noise = "{position: 0.0001, orientation: 0.001}";
  text.replace(text.find(noise), noise.size(), "{position: 1e-6, orientation: 1e-5}");
  folder.Write("d.yaml", text);
  ASSERT_EQ(Call({"simulate", "d.yaml", "--model=m.yaml", "--out=data", "--quiet"}).status, 0);
  folder.Write("stale.yaml", std::string(kModel) + effect + "0.0002}}\n");
  const ProgramResult result = Calibrate({"--model=stale.yaml", "--out=out"}, "scaled");
  EXPECT_EQ(result.status, 0) << result.err;
  const Machine found = ReadMachine(folder.Path("out/scaled/model.yaml"));
  ASSERT_EQ(found.effects.size(), 1U);
  const double sigma = found.effects[0].standard_deviation[0];
  EXPECT_GT(sigma, 0.0);
  EXPECT_LT(sigma, 5e-5);
  EXPECT_NEAR(found.effects[0].parameters[0], 5e-4, 4 * sigma);
  const nlohmann::json json = nlohmann::json::parse(Result("out/scaled"));
  EXPECT_EQ(json["effects"][0]["name"], "tracker_scale");
  EXPECT_EQ(json["effects"][0]["parameters"]["scale"], found.effects[0].parameters[0]);
}

TEST_F(CliCalibrate, AModelWithEffectsGoesWithThePlainMethodOnly) {
  folder.Write(
      "grown.yaml",
      std::string(kModel) + "effects:\n  - {name: tracker_scale, parameters: {scale: 0.001}}\n");
  for (const char* flag : {"--loss=huber", "--solver=linearized", "--outliers=reject"})
    EXPECT_EQ(Calibrate({"--model=grown.yaml", "--out=out", flag}).status, 2) << flag;
}

// Markers of a tracker that stood still: the model also says where it stood, by either residual.
TEST_F(CliCalibrate, AStaticTrackersPlaceIsInTheModel) {
  folder.Write(
      "d.yaml",
      "format: hexcal/dataset/1\nname: still\nunits: {length: m, angle: rad}\n"
      "robot_poses:\n  rows:\n    - [pose, x, y, z, rx, ry, rz]\n" +
          std::string(kGoodRows) +
          "tracker: {static: true, pose: {xyz: [1, 2, 3], quaternion: [0.6, 0, 0.8, 0]}}\n"
          "measurement:\n  kind: markers\n  noise: {sigma: 0.0001}\n"
          "  bodies:\n"
          "    base: {frame: rigid, markers: {a: [0, 0, 0], b: [1, 0, 0], c: [0, 1, 0]}}\n"
          "    tool: {frame: rigid, markers: {a: [0, 0, 0], b: [1, 0, 0], c: [0, 1, 0]}}\n");
  ASSERT_EQ(
      Call({"simulate", "d.yaml", "--model=m.yaml", "--out=data", "--quiet", "--noise=0"}).status,
      0);
  const Pose3d tracker_from_world{Eigen::Vector3d(1, 2, 3), Eigen::Quaterniond(0.6, 0, 0.8, 0)};
  for (const std::string residual : {"marker", "pose"}) {
    const ProgramResult result =
        Calibrate({"--out=" + residual, "--residual=" + residual}, "still");
    EXPECT_EQ(result.status, 0) << result.err;
    const Machine found = ReadMachine(folder.Path(residual + "/still/model.yaml"));
    ASSERT_TRUE(found.world_from_tracker.has_value());
    EXPECT_TRUE(PoseNear(*found.world_from_tracker, tracker_from_world.Inverse(), 1e-9, 1e-9));
    const nlohmann::json json = nlohmann::json::parse(Result(residual + "/still"));
    EXPECT_EQ(json["residual"], residual);
    EXPECT_EQ(json["poses"][2].contains("markers"), residual == "marker");
  }
  // Markers are the default.
  EXPECT_EQ(Calibrate({"--out=out"}, "still").status, 0);
  EXPECT_EQ(Result("out/still"), Result("marker/still"));
}

TEST_F(CliCalibrate, TheResultSaysWhatItIs) {
  EXPECT_EQ(Calibrate({"--out=out"}).status, 0);
  const nlohmann::json result = nlohmann::json::parse(Result("out/good"));
  EXPECT_EQ(result["format"], "hexcal/result/1");
  EXPECT_EQ(result["dataset"], "good");
  EXPECT_EQ(result["converged"], true);
  EXPECT_EQ(result["parameters"].size(), 12U);
  EXPECT_EQ(result["covariance"].size(), 12U);
  EXPECT_EQ(result["poses"].size(), 6U);
}

TEST_F(CliCalibrate, TheBytesDependNeitherOnTheRunNorOnTheThreads) {
  EXPECT_EQ(Calibrate({"--out=one", "--threads=1"}).status, 0);
  EXPECT_EQ(Calibrate({"--out=two", "--threads=2", "--quiet"}).status, 0);
  EXPECT_THAT(Result("one/good"), Not(IsEmpty()));
  EXPECT_EQ(Result("one/good"), Result("two/good"));
  EXPECT_EQ(folder.Read("one/good/model.yaml"), folder.Read("two/good/model.yaml"));
}

TEST_F(CliCalibrate, OneResidualBlockAPoseFindsTheSame) {
  EXPECT_EQ(Calibrate({"--out=one"}).status, 0);
  EXPECT_EQ(Calibrate({"--out=two", "--evaluation=per_pose"}).status, 0);
  const nlohmann::json one = nlohmann::json::parse(Result("one/good"));
  const nlohmann::json two = nlohmann::json::parse(Result("two/good"));
  for (const char* mount : {"world_from_base", "platform_from_tool"})
    for (int i = 0; i < 3; ++i)
      EXPECT_NEAR(double(one[mount]["xyz"][i]), double(two[mount]["xyz"][i]), 1e-10);
  for (int i = 0; i < 12; ++i) {
    const double sigma = two["standard_deviation"][i];
    EXPECT_NEAR(double(one["standard_deviation"][i]), sigma, 1e-10 * sigma);
  }
}

// The noise is stated: normal quantiles, which no number of degrees of freedom limits.
TEST_F(CliCalibrate, IntervalsGoWithTheStandardDeviations) {
  EXPECT_EQ(Calibrate({"--out=out"}).status, 0);
  const nlohmann::json result = nlohmann::json::parse(Result("out/good"));
  for (int i = 0; i < 12; ++i) {
    EXPECT_NEAR(
        double(result["half_width_95"][i]) / double(result["standard_deviation"][i]), 1.96, 0.001);
    EXPECT_TRUE(result["effective_degrees_of_freedom"][i].is_null());
  }
  EXPECT_NEAR(double(result["ellipsoid_95"]), 21.026, 0.001);
}

TEST_F(CliCalibrate, JsonIsAnObjectALineAndNothingElse) {
  Make("other", kGoodRows);
  const ProgramResult result = Calibrate({"data/other/dataset.yaml", "--out=out", "--json"});
  EXPECT_EQ(result.status, 0) << result.err;
  std::istringstream lines(result.out);
  std::vector<std::string> names;
  for (std::string line; std::getline(lines, line);)
    names.push_back(nlohmann::json::parse(line)["dataset"]);
  EXPECT_EQ(names, (std::vector<std::string>{"good", "other"}));
}

TEST_F(CliCalibrate, AReportIsWrittenWhereItIsAskedFor) {
  ASSERT_EQ(Calibrate({"--out=out"}).status, 0);
  EXPECT_FALSE(std::filesystem::exists(folder.Path("out/good/report.html")));
  ASSERT_EQ(Calibrate({"--out=out", "--report"}).status, 0);
  const std::string once = folder.Read("out/good/report.html");
  EXPECT_THAT(once, HasSubstr("id=\"verdict\"><strong>calibrated</strong>"));
  ASSERT_EQ(Calibrate({"--out=out", "--report"}).status, 0);
  EXPECT_EQ(folder.Read("out/good/report.html"), once);
  Make("turn", kOneAxisRows);
  EXPECT_EQ(Calibrate({"--out=out", "--report"}, "turn").status, 4);
  EXPECT_THAT(folder.Read("out/turn/report.html"), HasSubstr("<strong>not determined</strong>"));
  Make("exact", kGoodRows, "0");
  EXPECT_EQ(Calibrate({"--out=out", "--report"}, "exact").status, 0);
  folder.Write("out/good/report.html", "<html>mine</html>");
  EXPECT_EQ(Calibrate({"--out=out", "--report"}).status, 5);
}

TEST_F(CliCalibrate, QuietPrintsNothing) {
  const ProgramResult result = Calibrate({"--out=out", "--quiet"});
  EXPECT_THAT(result.out, IsEmpty());
  EXPECT_THAT(result.err, IsEmpty());
}

TEST_F(CliCalibrate, WhatTheDataCannotDetermineIsStatusFourAndStillWritten) {
  Make("one_axis", kOneAxisRows);
  const ProgramResult result = Calibrate({"--out=out"}, "one_axis");
  EXPECT_EQ(result.status, 4) << result.err;
  const nlohmann::json written = nlohmann::json::parse(Result("out/one_axis"));
  EXPECT_FALSE(written["observability"]["weak_directions"].empty());
}

// Sixteen poses, of which the robot reports one 30 mm from where it stood when it was measured.
TEST_F(CliCalibrate, AnOutlierIsNamedAndLeftOutOnlyWhereThatIsAskedFor) {
  std::string rows = kGoodRows;
  for (int i = 0; i < 10; ++i)
    rows += "    - [g" + std::to_string(i) + ", 0.0" + std::to_string(i) + ", -0.02, 0.4, 0." +
            std::to_string((7 * i) % 4) + ", -0." + std::to_string((3 * i) % 4) + ", 0." +
            std::to_string((5 * i) % 3) + "]\n";
  Make("spoilt", rows);
  std::string dataset = folder.Read("data/spoilt/poses.csv");
  ASSERT_NE(dataset.find("b,0.05,"), std::string::npos) << dataset;
  folder.Write("data/spoilt/poses.csv", dataset.replace(dataset.find("b,0.05,"), 7, "b,0.08,"));

  const ProgramResult kept = Calibrate({"--out=kept"}, "spoilt");
  EXPECT_EQ(kept.status, 0);
  EXPECT_THAT(kept.err, HasSubstr("pose b looks like an outlier, but is used: position"));
  EXPECT_THAT(kept.out, HasSubstr("1 of 16 poses, used all the same"));
  const auto with = nlohmann::json::parse(Result("kept/spoilt"));
  EXPECT_EQ(with["outliers"][0]["pose"], "b");
  EXPECT_EQ(with["poses"][1]["weight"], 1.0);

  const ProgramResult rejected = Calibrate({"--out=rejected", "--outliers=reject"}, "spoilt");
  EXPECT_EQ(rejected.status, 0);
  EXPECT_THAT(rejected.err, HasSubstr("1 of 16 poses left out as outliers: b"));
  EXPECT_THAT(rejected.out, HasSubstr("1 of 16 poses, left out"));
  const auto without = nlohmann::json::parse(Result("rejected/spoilt"));
  EXPECT_EQ(without["outliers"][0]["pose"], "b");
  EXPECT_THAT(std::string(without["outliers"][0]["reason"]), HasSubstr("mm), most along"));
  EXPECT_EQ(without["poses"][1]["weight"], 0.0);
  EXPECT_EQ(without["poses"].size(), 16u);
  EXPECT_LT(without["rmspe"], 0.001);
  EXPECT_GT(with["rmspe"], 0.002);

  // nothing to leave out
  ASSERT_EQ(Calibrate({"--out=a"}).status, 0);
  ASSERT_EQ(Calibrate({"--out=b", "--outliers=reject"}).status, 0);
  EXPECT_EQ(Result("a/good"), Result("b/good"));
}

TEST_F(CliCalibrate, ItsOwnResultsAreReplacedAndOthersAreNot) {
  EXPECT_EQ(Calibrate({"--out=out"}).status, 0);
  EXPECT_EQ(Calibrate({"--out=out", "--solver=linearized", "--error=twist"}).status, 0);
  folder.Write("out/good/result.json", "{}");
  const ProgramResult refused = Calibrate({"--out=out"});
  EXPECT_EQ(refused.status, 5);
  EXPECT_THAT(refused.err, HasSubstr("result.json: this file is in the way"));
  EXPECT_EQ(Result("out/good"), "{}");
  EXPECT_EQ(Calibrate({"--out=out", "--force"}).status, 0);
}

TEST_F(CliCalibrate, DatasetsOfOneNameAreRefusedBeforeAnythingIsComputed) {
  const ProgramResult result = Calibrate({"data/good/dataset.yaml", "--out=out"});
  EXPECT_EQ(result.status, 3);
  EXPECT_THAT(result.err, HasSubstr("found the name 'good'"));
  EXPECT_THAT(folder.Names(), UnorderedElementsAre("d.yaml", "data", "m.yaml"));
}

TEST_F(CliCalibrate, OneBadDatasetOfTwoIsStatusSixAndTheOtherIsDone) {
  folder.Write("bad.yaml", "format: hexcal/dataset/1\n");
  const ProgramResult result = Calibrate({"bad.yaml", "--out=out"});
  EXPECT_EQ(result.status, 6);
  EXPECT_THAT(result.err, HasSubstr("bad.yaml"));
  EXPECT_THAT(Result("out/good"), Not(IsEmpty()));
}

TEST_F(CliCalibrate, FlagsThatDoNotGoTogetherAreWrongUsage) {
  const auto expect_wrong_usage = [&](const Arguments& flags, const char* message) {
    Arguments more = {"--out=out"};
    more.insert(more.end(), flags.begin(), flags.end());
    const ProgramResult result = Calibrate(more);
    EXPECT_EQ(result.status, 2) << message;
    EXPECT_THAT(result.err, HasSubstr(message));
  };
  expect_wrong_usage({"--residual=marker"}, "is of kind poses, it has no markers");
  expect_wrong_usage({"--residual=markers"}, "found 'markers', expected marker or pose");
  expect_wrong_usage({"--residual=marker", "--solver=linearized"},
                     "--residual=marker goes with --solver=nonlinear only");
  expect_wrong_usage({"--error=paper"}, "--error has an effect only with --solver=linearized");
  expect_wrong_usage({"--noise_position=0.1"}, "--noise_position needs --noise_orientation");
  expect_wrong_usage({"--solver=linear"}, "found 'linear', expected nonlinear or linearized");
  expect_wrong_usage({"--start=middle"}, "expected closed_form, initial");
  expect_wrong_usage({"--loss_scale=3"}, "--loss_scale needs --loss");
  expect_wrong_usage({"--loss=none", "--loss_scale=3"}, "needs a --loss other than none");
  expect_wrong_usage({"--loss=l1"}, "expected none, huber, cauchy or tukey");
  expect_wrong_usage({"--loss=huber", "--solver=linearized"}, "go with --solver=nonlinear only");
  expect_wrong_usage({"--covariance=robust"}, "expected model or sandwich");
  expect_wrong_usage({"--outliers=drop"}, "found 'drop', expected keep or reject");
  expect_wrong_usage({"--threads=0"}, "expected a whole number from 1 to 1024");
  EXPECT_THAT(folder.Names(), UnorderedElementsAre("d.yaml", "data", "m.yaml"));
}

TEST_F(CliCalibrate, SaysWhetherTheSolutionIsTheBestAnywhere) {
  ASSERT_EQ(Calibrate({"--out=out", "--quiet"}).status, 0);
  const auto result = nlohmann::json::parse(Result("out/good"));
  EXPECT_EQ(result["certificate"]["certified"], true);
  EXPECT_EQ(result["certificate"]["exact"], true);
  EXPECT_LT(result["certificate"]["gap"], 1e-5);
  EXPECT_GT(result["certificate"]["smallest_eigenvalue"], 0.0);
  Calibrate({"--out=out", "--quiet", "--solver=linearized"});
  EXPECT_TRUE(nlohmann::json::parse(Result("out/good"))["certificate"].is_null());
}

}  // namespace
}  // namespace hexcal
