// SPDX-License-Identifier: BSD-3-Clause
// What an audit says of effects that its model lacks, of a screening made by hand.
#include "report/missing_effects.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "testing/audits.h"

namespace hexcal {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

Hypothesis Offset(double rms, double uncertainty) {
  Hypothesis one;
  one.name = "base_joint_offset";
  one.labels = {"base joint 1", "base joint 2", "base joint 6"};
  one.parameters = one.told = 12;
  one.directions = 18;
  one.unit = "m";
  one.at_points = {rms};
  one.at_points_uncertainty = {uncertainty};
  return one;
}

std::string PageOf(const Audit& audit) {
  HtmlPage page("test", "t", "s");
  AddMissingEffects(audit, &page);
  return page.Html();
}

// What the one requirement leaves is the yardstick: rms + 2 u a little less, and a little more.
TEST(MissingEffects, SayWhatTheyDoNotExclude) {
  const testing::AuditedExample example = testing::AuditExample();
  Audit audit = MakeAudit(example.Input(testing::ExampleRequirements()));
  ASSERT_EQ(audit.decisions.size(), 1u);
  const Decision& decision = audit.decisions[0];
  const double leaves = decision.requirement.limit - decision.value - decision.guard;
  ASSERT_GT(leaves, 0.0);
  audit.missing.emplace().tested = {Offset(0.5 * leaves, 0.249 * leaves)};
  EXPECT_TRUE(JsonMissingEffects(audit)["not_excluded"].empty());
  EXPECT_THAT(PageOf(audit), Not(HasSubstr("do not exclude")));

  audit.missing->tested = {Offset(0.5 * leaves, 0.251 * leaves)};
  const nlohmann::ordered_json json = JsonMissingEffects(audit);
  ASSERT_EQ(json["not_excluded"].size(), 1u);
  EXPECT_EQ(json["not_excluded"][0]["effect"], "base_joint_offset");
  EXPECT_EQ(json["not_excluded"][0]["requirement"], "drilling");
  EXPECT_EQ(json["not_excluded"][0]["point"], "tool tip");
  EXPECT_NEAR(json["not_excluded"][0]["could_move"], 1.002 * leaves, 1e-12);
  EXPECT_EQ(json["tested"][0]["told"], 12);
  EXPECT_EQ(json["tested"][0]["directions"], 18);
  const std::string page = PageOf(audit);
  EXPECT_THAT(page, HasSubstr("do not exclude"));
  EXPECT_THAT(page, HasSubstr("base_joint_offset (base joint 1 to 6): up to"));
  EXPECT_THAT(page, HasSubstr("in part: 6 of 18 directions"));
  EXPECT_THAT(page, HasSubstr(">12 of 18</td>"));

  std::vector<std::string> doubts;
  AddDoubtsOfMissing(audit, &doubts);
  EXPECT_TRUE(doubts.empty());               // it has no name
  audit.missing->tested[0].is_named = true;  // a doubt already
  EXPECT_TRUE(JsonMissingEffects(audit)["not_excluded"].empty());
}

TEST(MissingEffects, SayHowManyOfThemThePictureHas) {
  Audit audit;
  audit.missing.emplace().tested.assign(12, Offset(1e-6, 1e-6));
  EXPECT_THAT(PageOf(audit), HasSubstr("corrected p of each effect"));
  audit.missing->tested.resize(21, Offset(1e-6, 1e-6));
  EXPECT_THAT(PageOf(audit), HasSubstr("the first 12 of the 21 effects in the table"));
}

}  // namespace
}  // namespace hexcal
