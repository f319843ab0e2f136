// SPDX-License-Identifier: BSD-3-Clause
// hexcal audit of data without noise: only the rounding of the numbers is left over.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "testing/run_program.h"
#include "testing/temporary_folder.h"

namespace hexcal {
namespace {

using ::hexcal::testing::ProgramResult;
using ::hexcal::testing::RunHexcal;
using ::hexcal::testing::TemporaryFolder;
using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::json;

const std::string kExamples = HEXCAL_EXAMPLES;
constexpr const char* kSentence =
    "only the rounding of the numbers is left over: nothing can be said of the noise";

// No number is beyond what anything of a machine may be.
void ExpectSane(const Json& value, const std::string& name) {
  if (value.is_number()) {
    EXPECT_LT(std::abs(value.get<double>()), 1e9) << name;
  }
  if (!value.is_structured()) return;
  for (const auto& [key, part] : value.items()) ExpectSane(part, name + "." + key);
}

TEST(CliAuditRounding, SaysThatNothingIsKnownOfTheNoiseAndPassesNothing) {
  const TemporaryFolder folder;
  const ProgramResult run = RunHexcal({{"audit",
                                        kExamples + "/paper/dataset.yaml",
                                        "--requirement=" + kExamples + "/neurobot/requirement.yaml",
                                        "--out=out"},
                                       folder.Path("")});
  ASSERT_EQ(run.status, 0) << run.err;
  const Json audit = Json::parse(folder.Read("out/paper/audit.json"));
  EXPECT_EQ(audit["verdict"], "INCONCLUSIVE");
  EXPECT_EQ(audit["doubts"], Json::array({kSentence}));
  EXPECT_EQ(audit["global_test"]["only_rounding"], true);
  EXPECT_NEAR(audit["global_test"]["chi_square"].get<double>(), 24.0, 1e-9);
  ExpectSane(audit, "audit");

  const Json result = Json::parse(folder.Read("out/paper/result.json"));
  EXPECT_NEAR(result["noise_scale"].get<double>(), 1.0, 1e-9);
  for (const Json& half_width : result["half_width_95"]) {
    ASSERT_TRUE(half_width.is_number());
    EXPECT_LT(half_width.get<double>(), 1e-12);
  }

  EXPECT_THAT(run.out, HasSubstr(std::string("chi-square     not tested: ") + kSentence));
  EXPECT_THAT(run.out, HasSubstr("with its guard band of 0 µm"));
  const std::string page = folder.Read("out/paper/report.html");
  EXPECT_THAT(page, HasSubstr(std::string("Here ") + kSentence));
  EXPECT_THAT(page, Not(HasSubstr("Birge")));
  // What is not tested is not said to agree.
  EXPECT_THAT(page, HasSubstr(std::string("Neither poses nor readings are tested: ") + kSentence));
  EXPECT_THAT(page, Not(HasSubstr("contradicts the others (at")));
  EXPECT_THAT(page, Not(HasSubstr("would be found from")));
  EXPECT_THAT(page,
              HasSubstr("<td>base.dx, mm</td><td class=\"number\">0</td>"
                        "<td class=\"number\">–</td><td class=\"number\">–</td>"));
  EXPECT_THAT(run.out, Not(HasSubstr("single marker readings")));
  EXPECT_THAT(page, Not(HasSubstr("not determined</td>")));
  EXPECT_THAT(page, Not(HasSubstr("0000000 times enlarged")));
}

// Between exact data and others nothing is known of one side's noise: no chance is reckoned.
TEST(CliAuditRounding, TestsNoChangeOfExactData) {
  const TemporaryFolder folder;
  const auto run = [&](const std::vector<std::string>& words) {
    return RunHexcal({words, folder.Path("")});
  };
  ASSERT_EQ(run({"calibrate", kExamples + "/neurobot/dataset.yaml", "--out=first"}).status, 0);
  const ProgramResult result = run({"audit",
                                    kExamples + "/paper/dataset.yaml",
                                    "--previous=first/neurobot/result.json",
                                    "--out=out"});
  ASSERT_EQ(result.status, 0) << result.err;
  const Json change = Json::parse(folder.Read("out/paper/audit.json"))["change"];
  EXPECT_TRUE(change["p_value"].is_null() && change["chi_square"].is_null());
  EXPECT_TRUE(change["sigmas"][0].is_null());
  EXPECT_THAT(result.out, HasSubstr("not tested since first/neurobot/result.json: in one of"));
  EXPECT_THAT(folder.Read("out/paper/report.html"), HasSubstr("Not tested: in one of the two"));
}

}  // namespace
}  // namespace hexcal
