// SPDX-License-Identifier: BSD-3-Clause
// hexcal plan from outside. What it chooses is tested with plan.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "testing/cli_test.h"

namespace hexcal {
namespace {

using ::hexcal::testing::ProgramResult;
using ::testing::HasSubstr;
using ::testing::StartsWith;
using Json = nlohmann::json;

const std::string kNeurobot = std::string(HEXCAL_EXAMPLES) + "/neurobot/dataset.yaml";

class CliPlan : public testing::CliTest {
 protected:
  void SetUp() override {
    const ProgramResult result = Call({"calibrate", kNeurobot, "--out=out", "--quiet"});
    ASSERT_EQ(result.status, 0) << result.err;
  }

  ProgramResult Plan(const std::string& dataset, const std::vector<std::string>& more) const {
    return Call({"plan", dataset, "--model=out/neurobot/model.yaml", "--pool=60", "--poses=5"},
                more);
  }
};

TEST_F(CliPlan, WritesATableThatIsRobotPosesOfANewDataset) {
  const ProgramResult result = Plan(kNeurobot, {"--out=next.csv"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("5 poses to measure next, for base and tool; 60 measured"));
  EXPECT_THAT(result.out, HasSubstr("written to     next.csv"));
  const std::string table = folder.Read("next.csv");
  EXPECT_THAT(table, StartsWith("# Written by hexcal plan for neurobot"));
  EXPECT_THAT(table, HasSubstr("\n# plan-1: determines "));
  EXPECT_THAT(table, HasSubstr("\nplan-5,"));
  // The dataset's own description, with the new table in the place of the old one.
  std::ifstream file(kNeurobot);
  std::string yaml((std::istreambuf_iterator<char>(file)), {});
  const auto replace = [&yaml](const std::string& old, const std::string& by) {
    ASSERT_NE(yaml.find(old), std::string::npos) << old;
    yaml.replace(yaml.find(old), old.size(), by);
  };
  replace("poses.csv", "next.csv");
  replace("  file: markers.csv\n", "");
  folder.Write("next.yaml", yaml);
  const ProgramResult again =
      Call({"predict", "next.yaml", "--model=out/neurobot/model.yaml", "--out=where.csv"});
  EXPECT_EQ(again.status, 0) << again.err;
  EXPECT_THAT(folder.Read("where.csv"), HasSubstr("\nplan-5,"));
}

TEST_F(CliPlan, WritesJsonTheSameBytesTwice) {
  ASSERT_EQ(Plan(kNeurobot, {"--out=a.json", "--quiet"}).status, 0);
  const ProgramResult again = Plan(kNeurobot, {"--out=b.json", "--json"});
  ASSERT_EQ(again.status, 0) << again.err;
  EXPECT_EQ(folder.Read("a.json"), folder.Read("b.json"));
  const Json plan = Json::parse(folder.Read("a.json"));
  EXPECT_EQ(Json::parse(again.out), plan);
  EXPECT_EQ(plan["format"], "hexcal/plan/1");
  EXPECT_EQ(plan["for"], "parameters");
  EXPECT_EQ(plan["measured"], 60);
  ASSERT_EQ(plan["poses"].size(), 5u);
  EXPECT_EQ(plan["parameters"].size(), 12u);
  for (int k = 0; k < 12; ++k)
    EXPECT_LT(plan["standard_deviation"]["after"][k].get<double>(),
              plan["standard_deviation"]["before"][k].get<double>());
  // Its own earlier results are replaced, other files are not.
  EXPECT_EQ(Plan(kNeurobot, {"--out=a.json", "--quiet"}).status, 0);
  folder.Write("mine.csv", "pose,x\n");
  EXPECT_EQ(Plan(kNeurobot, {"--out=mine.csv"}).status, 5);
  EXPECT_EQ(Plan(kNeurobot, {"--out=mine.csv", "--force"}).status, 0);
}

TEST_F(CliPlan, SetsColumnsAsAsked) {
  const std::string loaded = std::string(HEXCAL_EXAMPLES) + "/hidden-effect/dataset.yaml";
  const auto plan = [&](const std::string& settings) {
    return Plan(loaded, {"--out=set.json", "--quiet", "--settings=" + settings});
  };
  ASSERT_EQ(plan("payload=0:7.5,temperature=18").status, 0);
  const Json result = Json::parse(folder.Read("set.json"));
  EXPECT_EQ(result["settings"]["columns"]["payload"], (std::vector<double>{0.0, 7.5}));
  std::set<double> loads;
  double last = 0.0;
  for (const Json& pose : result["poses"]) {
    loads.insert(pose["covariates"]["payload"].get<double>());
    EXPECT_EQ(pose["covariates"]["temperature"], 18.0);
    EXPECT_GT(pose["covariates"]["time"].get<double>(), last);
    last = pose["covariates"]["time"];
  }
  EXPECT_EQ(loads, (std::set<double>{0.0, 7.5}));
  for (const auto& [settings, message] :
       {std::pair("weight=3", "found 'weight', expected one of temperature, payload"),
        std::pair("time=3", "found 'time', expected one of temperature, payload"),
        std::pair("payload", "found 'payload', expected COLUMN=A:B"),
        std::pair("payload=1:x", "found 'x', expected a number"),
        std::pair("payload=1,payload=2", "expected each column once")}) {
    const ProgramResult refused = plan(settings);
    EXPECT_EQ(refused.status, 2) << settings;
    EXPECT_THAT(refused.err, HasSubstr(message));
  }
  EXPECT_THAT(Plan(kNeurobot, {"--out=a.json", "--settings=payload=1"}).err,
              HasSubstr("the dataset has no covariates that can be set"));
}

TEST_F(CliPlan, RefusesWhatItCannotUse) {
  const ProgramResult other = Plan(kNeurobot, {"--out=plan.txt"});
  EXPECT_EQ(other.status, 2);
  EXPECT_THAT(other.err, HasSubstr("found 'plan.txt', expected a file that ends in .csv or .json"));
  EXPECT_EQ(Plan(kNeurobot, {"--out=a.csv", "--for=fun"}).status, 2);
  EXPECT_EQ(Call({"plan", kNeurobot, "--out=a.csv"}).status, 2);
  const ProgramResult many = Call({"plan",
                                   kNeurobot,
                                   "--model=out/neurobot/model.yaml",
                                   "--out=a.csv",
                                   "--poses=80",
                                   "--pool=60"});
  EXPECT_EQ(many.status, 2);
  EXPECT_THAT(many.err, HasSubstr("expected at most --pool, 60"));
  const ProgramResult missing = Plan("nowhere.yaml", {"--out=a.csv"});
  EXPECT_EQ(missing.status, 3);
  const ProgramResult alone = Plan(kNeurobot, {"--out=a.csv", "--for=rivals"});
  EXPECT_EQ(alone.status, 3);
  EXPECT_THAT(alone.err, HasSubstr("model.yaml"));
  EXPECT_THAT(alone.err, HasSubstr("a model without effects"));
}

}  // namespace
}  // namespace hexcal
