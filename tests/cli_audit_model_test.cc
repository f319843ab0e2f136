// SPDX-License-Identifier: BSD-3-Clause
// hexcal audit --model from outside: neurobot's own plan, measured with effects.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "testing/cli_test.h"

namespace hexcal {
namespace {

using ::hexcal::testing::ProgramResult;
using ::testing::HasSubstr;
using Json = nlohmann::json;

const std::string kExample = std::string(HEXCAL_EXAMPLES) + "/neurobot/";

std::string TextOf(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

class CliAuditModel : public testing::CliTest {
 protected:
  CliAuditModel() { folder.Write("plain.yaml", TextOf(kExample + "truth.yaml")); }

  // The example measured with this effect, and a model that has half of it.
  void Measure(const std::string& effect, const std::string& half) {
    const std::string truth = TextOf(kExample + "truth.yaml");
    folder.Write("truth.yaml", truth + "effects:\n  - {" + effect + "}\n");
    folder.Write("model.yaml", truth + "effects:\n  - {" + half + "}\n");
    const ProgramResult made = Call(
        {"simulate", kExample + "dataset.yaml", "--model=truth.yaml", "--out=data", "--quiet"});
    ASSERT_EQ(made.status, 0) << made.err;
  }

  ProgramResult Audit(const std::vector<std::string>& more,
                      const std::string& dataset = "data/neurobot/dataset.yaml") const {
    return Call({"audit", dataset, "--out=out", "--draws=1000", "--folds=2", "--quiet"}, more);
  }

  Json Read(const std::string& name) const {
    return Json::parse(folder.Read("out/neurobot/" + name));
  }

  const std::string requirement = "--requirement=" + kExample + "requirement.yaml";
};

TEST_F(CliAuditModel, TheErrorHoldsTheEffectsUncertainty) {
  Measure("name: tracker_scale, parameters: {scale: 0.001}",
          "name: tracker_scale, parameters: {scale: 0.0005}");
  const ProgramResult result = Audit({"--model=model.yaml", requirement});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("the fit is by poses, made of the markers' readings"));
  const Json audit = Read("audit.json");
  EXPECT_EQ(audit["verdict"], "PASS") << audit["doubts"];
  EXPECT_TRUE(audit["missing_effects"]["named"].empty()) << audit["missing_effects"]["named"];
  EXPECT_EQ(audit["inputs"].size(), 5u);  // dataset, poses, markers, model, requirement
  const Json& budget = audit["points"][0]["budget"];
  EXPECT_EQ(budget[0]["source"], "calibration of base and tool");
  EXPECT_EQ(budget[1]["source"], "effects of the model");
  EXPECT_GT(budget[1]["rms"], 0.0);
  // The numbers of both: the 12 and the scale, which moves the tool by its correlations alone.
  const Json& numbers = audit["points"][0]["calibration"]["parameters"];
  ASSERT_EQ(numbers.size(), 13u);
  EXPECT_EQ(numbers[12]["parameter"], "tracker_scale scale");
  EXPECT_EQ(numbers[12]["sensitivity"], 0.0);
  const double first = numbers[0]["rms"], share = numbers[0]["share"];
  const double known = budget[0]["rms"], added = budget[1]["rms"];
  EXPECT_NEAR(first * first / share / (known * known + added * added), 1.0, 1e-9);
  EXPECT_TRUE(audit["points"][0]["monte_carlo"]["agrees"]);
  EXPECT_EQ(audit["model"]["effects"][0]["name"], "tracker_scale");
  const double scale = audit["model"]["effects"][0]["parameters"]["scale"];
  const double sigma = audit["model"]["effects"][0]["standard_deviation"]["scale"];
  EXPECT_LT(std::abs(scale - 0.001), 4.0 * sigma);
  // result.json and model.yaml are those of calibrate --model.
  const ProgramResult calibrated =
      Call({"calibrate", "data/neurobot/dataset.yaml", "--model=model.yaml", "--out=c", "--quiet"});
  ASSERT_EQ(calibrated.status, 0) << calibrated.err;
  for (const char* name : {"result.json", "model.yaml"})
    EXPECT_EQ(folder.Read(std::string("c/neurobot/") + name),
              folder.Read(std::string("out/neurobot/") + name));
  const std::string report = folder.Read("out/neurobot/report.html");
  EXPECT_THAT(report, HasSubstr("Effects of the model"));
  EXPECT_THAT(report, HasSubstr("tracker_scale"));
}

// Without its effect the same data contradict their noise.
TEST_F(CliAuditModel, WithoutTheModelNothingPasses) {
  Measure("name: tracker_scale, parameters: {scale: 0.001}",
          "name: tracker_scale, parameters: {scale: 0.0005}");
  ASSERT_EQ(Audit({requirement}).status, 0);
  EXPECT_EQ(Read("audit.json")["verdict"], "INCONCLUSIVE");
  EXPECT_FALSE(Read("audit.json").contains("model"));
}

TEST_F(CliAuditModel, AModelWithoutEffectsChangesNothing) {
  ASSERT_EQ(Audit({requirement}, kExample + "dataset.yaml").status, 0);
  Json without = Read("audit.json");
  const std::string result = folder.Read("out/neurobot/result.json");
  ASSERT_EQ(Audit({requirement, "--model=plain.yaml"}, kExample + "dataset.yaml").status, 0);
  Json with = Read("audit.json");
  EXPECT_EQ(folder.Read("out/neurobot/result.json"), result);
  EXPECT_NE(with["id"], without["id"]);  // of other inputs
  for (const char* key : {"id", "inputs"}) with.erase(key), without.erase(key);
  EXPECT_EQ(with, without);
}

// The calibration's own data say nothing of when a step was.
TEST_F(CliAuditModel, WhatIsHeldKeepsRequirementsFromPassing) {
  const std::string step =
      "name: tool_step, parameters: {twist: [0, 0, 0.0002, 0, 0, 0], time: 30},"
      " reference: {time_is_row: 1}";
  Measure(step, step);
  const ProgramResult result = Audit({"--model=model.yaml", requirement});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(Read("audit.json")["verdict"], "INCONCLUSIVE");
  EXPECT_EQ(Read("audit.json")["model"]["held"][0], "the time of 'tool_step'");
}

TEST_F(CliAuditModel, RefusesWhatDoesNotGoWithEffects) {
  Measure("name: tracker_scale, parameters: {scale: 0.001}",
          "name: tracker_scale, parameters: {scale: 0.0005}");
  folder.Write("earlier.json", "{}");
  for (const char* flag : {"--solver=linearized",
                           "--residual=marker",
                           "--loss=huber",
                           "--covariance=sandwich",
                           "--outliers=reject",
                           "--previous=earlier.json"}) {
    const ProgramResult result = Audit({"--model=model.yaml", flag});
    EXPECT_EQ(result.status, 2) << flag;
    EXPECT_THAT(result.err, HasSubstr("--model with effects")) << flag;
  }
  EXPECT_EQ(Audit({"--model=none.yaml"}).status, 3);
}

}  // namespace
}  // namespace hexcal
