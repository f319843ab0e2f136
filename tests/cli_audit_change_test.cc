// SPDX-License-Identifier: BSD-3-Clause
// hexcal audit from outside: what stays the same, and what has changed since an earlier result.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "testing/cli_audit.h"

namespace hexcal {
namespace {

using ::hexcal::testing::CliAudit;
using ::hexcal::testing::ProgramResult;
using ::hexcal::testing::RunHexcal;
using ::testing::AllOf;
using ::testing::HasSubstr;
using Json = nlohmann::json;

TEST_F(CliAudit, WritesTheSameBytesWhateverTheThreads) {
  ASSERT_EQ(Audit({bundled, "--threads=1", "--quiet"}).status, 0);
  std::vector<std::string> once;
  for (const char* name : {"audit.json", "result.json", "model.yaml"}) once.push_back(Read(name));
  const ProgramResult again = Audit({bundled, "--threads=3", "--json"});
  ASSERT_EQ(again.status, 0) << again.err;
  int i = 0;
  for (const char* name : {"audit.json", "result.json", "model.yaml"})
    EXPECT_EQ(Read(name), once[i++]) << name;
  EXPECT_EQ(Json::parse(again.out), Json::parse(Read("audit.json")));
}

// Against its own result nothing has changed, and nothing is tested: no reading is a new one.
TEST_F(CliAudit, TestsNoChangeBetweenResultsOfTheSameReadings) {
  ASSERT_EQ(Audit({"--quiet"}).status, 0);
  const std::string earlier = folder.Write("earlier.json", Read("result.json"));
  const ProgramResult result = Audit({"--residual=pose", "--previous=" + earlier});
  ASSERT_EQ(result.status, 0);
  const Json audit = Json::parse(Read("audit.json"));
  EXPECT_EQ(audit["verdict"], "none");
  const Json change = audit["change"];
  EXPECT_TRUE(change["p_value"].is_null() && change["chi_square"].is_null());
  EXPECT_TRUE(change["sigmas"][0].is_null());
  EXPECT_LT(std::abs(change["over_own"][0].get<double>()), 1.0);
  EXPECT_EQ(change["shared_readings"],
            Json::parse(R"({"known": true, "poses": 60, "of": 60, "earlier_of": 60})"));
  EXPECT_THAT(Read("report.html"),
              AllOf(HasSubstr("Change since an earlier calibration"),
                    HasSubstr("the very same readings of 60 poses"),
                    HasSubstr("no probability is given")));
  EXPECT_THAT(result.out, HasSubstr("60 poses have the same readings in both"));
}

// Of other readings of another machine: all has changed.
TEST_F(CliAudit, ComparesWithAnEarlierResultOfOtherReadings) {
  const ProgramResult other =
      RunHexcal({{"calibrate",
                  std::string(HEXCAL_EXAMPLES) + "/neurobot-test/dataset.yaml",
                  "--out=other",
                  "--quiet"},
                 folder.Path("")});
  ASSERT_EQ(other.status, 0) << other.err;
  ASSERT_EQ(Audit({"--quiet", "--previous=other/neurobot-test/result.json"}).status, 0);
  Json change = Json::parse(Read("audit.json"))["change"];
  EXPECT_EQ(change["shared_readings"]["known"], true);
  EXPECT_EQ(change["shared_readings"]["poses"], 0);
  EXPECT_GE(change["p_value"].get<double>(), 0.0);
  // One that does not say which readings it used, as hexcal wrote them once.
  std::string old = folder.Read("other/neurobot-test/result.json");
  for (std::size_t at; (at = old.find(",\"readings\":")) != std::string::npos;) old.erase(at, 30);
  ASSERT_EQ(Audit({"--quiet", "--previous=" + folder.Write("old.json", old)}).status, 0);
  change = Json::parse(Read("audit.json"))["change"];
  EXPECT_EQ(change["shared_readings"]["known"], false);
  EXPECT_FALSE(change["p_value"].is_null());
  EXPECT_THAT(Read("report.html"), HasSubstr("does not say which readings it used"));
}

}  // namespace
}  // namespace hexcal
