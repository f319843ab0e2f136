// SPDX-License-Identifier: BSD-3-Clause
#include "report/audit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "geometry/rotation_angles.h"
#include "report/accuracy_charts.h"
#include "report/audit_json.h"
#include "report/audit_table.h"
#include "report/decide.h"
#include "report/held_out.h"
#include "testing/audits.h"
#include "testing/matchers.h"

namespace hexcal {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

class AuditTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() { example = new testing::AuditedExample(testing::AuditExample()); }
  static void TearDownTestSuite() { delete example; }

  static Audit Make(double limit_m, double robot_m = 5e-6) {
    Requirements requirements = testing::ExampleRequirements();
    requirements.requirements[0].limit = limit_m;
    requirements.robot->source.position = robot_m;
    return MakeAudit(example->Input(requirements));
  }

  static testing::AuditedExample* example;
};
testing::AuditedExample* AuditTest::example = nullptr;

// The worst of the workspace is no better than any of its places, one by one.
TEST_F(AuditTest, WorstPlaceIsTheWorstOfAll) {
  const Audit audit = Make(5e-4);
  ASSERT_EQ(audit.points.size(), 1u);
  const NamedPoint& tip = audit.points[0].point;
  const TargetError error(audit.estimate, SourcesOf(audit, tip));
  double longest = 0.0;
  const auto places = GridOf(audit.workspace, example->dataset);
  EXPECT_EQ(places.size(), audit.places);
  EXPECT_GT(places.size(), 100u);
  for (const Place& place : places)
    longest = std::max(longest, error.At(place.base_from_platform, tip.p_in_tool).Quantile(0.95));
  EXPECT_NEAR(audit.points[0].worst.length_95 / longest, 1.0, 1e-9);
  EXPECT_NEAR(audit.decisions[0].value / longest, 1.0, 1e-9);
  EXPECT_LT(audit.points[0].centre.length_95, longest);
  for (const auto& height : audit.points[0].map.lengths)
    for (const auto& row : height)
      for (const double length : row)
        EXPECT_FALSE(length > longest * (1.0 + 1e-9));  // or nowhere reached
}

TEST_F(AuditTest, PassesFailsOrDoesNotKnowByTheGuardBand) {
  const Decision wide = Make(5e-4).decisions[0];
  EXPECT_EQ(wide.compliance, Compliance::kPass);
  EXPECT_GT(wide.guard, 0.0);
  EXPECT_LT(wide.guard, 0.2 * wide.value);
  EXPECT_EQ(Make(wide.value + 1.01 * wide.guard).compliance, Compliance::kPass);
  EXPECT_EQ(Make(wide.value + 0.99 * wide.guard).compliance, Compliance::kInconclusive);
  EXPECT_EQ(Make(wide.value - 0.99 * wide.guard).compliance, Compliance::kInconclusive);
  const Audit failed = Make(wide.value - 1.01 * wide.guard);
  EXPECT_EQ(failed.compliance, Compliance::kFail);
  EXPECT_THAT(failed.decisions[0].reason, HasSubstr("beyond the limit"));
}

// By hand: 708 degrees of freedom confirm a noise that makes nearly all of the error.
TEST_F(AuditTest, GuardBandIsTwiceTheUncertaintyOfTheStandardDeviation) {
  const Audit audit = Make(5e-4, 0.0);
  const Decision& decision = audit.decisions[0];
  const double share = audit.points[0].budget.rows[0].share;
  const double dof = audit.estimate.degrees_of_freedom;
  EXPECT_NEAR(decision.guard / decision.value, 2.0 * share / std::sqrt(2.0 * dof), 1e-6);
}

TEST_F(AuditTest, NothingPassesWithoutTheRobotsOwnError) {
  Requirements requirements = testing::ExampleRequirements();
  requirements.robot.reset();
  const Audit audit = MakeAudit(example->Input(requirements));
  EXPECT_EQ(audit.compliance, Compliance::kInconclusive);
  EXPECT_THAT(audit.decisions[0].reason, HasSubstr("robot's own error"));
  requirements.requirements[0].limit = 1e-6;  // but it may fail
  EXPECT_EQ(MakeAudit(example->Input(requirements)).compliance, Compliance::kFail);
}

TEST_F(AuditTest, NothingPassesOnDataThatContradictTheirNoise) {
  testing::AuditedExample rough = *example;
  rough.estimate.chi_square *= 2.0;
  Audit audit = MakeAudit(rough.Input(testing::ExampleRequirements()));
  EXPECT_TRUE(audit.global.is_too_large);
  EXPECT_EQ(audit.compliance, Compliance::kInconclusive);
  EXPECT_THAT(audit.decisions[0].reason, HasSubstr("more than the stated noise explains"));

  testing::AuditedExample undetermined = *example;
  undetermined.estimate.observability.null_directions = 1;
  undetermined.estimate.observability.weak_directions = {"a shift along z"};
  audit = MakeAudit(undetermined.Input(testing::ExampleRequirements()));
  EXPECT_EQ(audit.compliance, Compliance::kInconclusive);
  EXPECT_THAT(audit.decisions[0].reason, HasSubstr("a shift along z"));
}

TEST_F(AuditTest, NothingPassesWhereMoreThanOneInAHundredRepetitionsFailed) {
  testing::AuditedExample lost = *example;
  lost.comparison.propagation.not_converged = lost.comparison.propagation.draws / 100;
  EXPECT_EQ(MakeAudit(lost.Input(testing::ExampleRequirements())).compliance, Compliance::kPass);
  ++lost.comparison.propagation.not_converged;
  const Audit audit = MakeAudit(lost.Input(testing::ExampleRequirements()));
  EXPECT_EQ(audit.compliance, Compliance::kInconclusive);
  EXPECT_THAT(audit.decisions[0].reason,
              HasSubstr(" repetitions of the calibration did not converge"));
  EXPECT_THAT(AuditTable(audit), HasSubstr("did not converge"));
}

// The robot's error enlarges the value; the rows of the budget add up.
TEST_F(AuditTest, BudgetHoldsTheRobotsOwnError) {
  const Audit without = Make(5e-4, 0.0), with = Make(5e-4, 1e-4);
  EXPECT_GT(with.decisions[0].value, without.decisions[0].value);
  double sum = 0.0;
  bool has_robot = false;
  for (const BudgetRow& row : with.points[0].budget.rows) {
    sum += row.share;
    has_robot = has_robot || row.name == "robot's own error";
  }
  EXPECT_NEAR(sum, 1.0, 1e-12);
  EXPECT_TRUE(has_robot);
  EXPECT_TRUE(with.points[0].check->agrees);
}

// The law of independent errors is not theirs: with four poses one in seven was called too few.
TEST(HeldOutTest, OfFewerThanSixPosesNothingIsAsked) {
  PoseCheck outside;
  outside.squared = 1e3;
  for (const int poses : {3, 4, 5}) {
    const HeldOutTest test = HeldOutTestOf(std::vector<PoseCheck>(poses, outside));
    EXPECT_EQ(test.fewest, 0);
    EXPECT_EQ(test.inside, 0);
  }
  EXPECT_EQ(HeldOutTestOf(std::vector<PoseCheck>(6, outside)).fewest, 4);
}

// What no pose has seen is a stated reservation of a verdict about the workspace; it decides
// nothing, and has no say about the poses themselves.
TEST_F(AuditTest, AVerdictSaysWhereItsWorkspaceGoesBeyondThePoses) {
  EXPECT_THAT(Make(5e-4).decisions[0].reason, Not(HasSubstr("no pose was measured")));
  Requirements requirements = testing::ExampleRequirements();
  (*requirements.workspace)[0] = {-0.03, 0.02};
  requirements.requirements.push_back(requirements.requirements[0]);
  requirements.requirements[1].over = Requirement::Places::kPoses;
  const Audit audit = MakeAudit(example->Input(requirements));
  EXPECT_FALSE(audit.workspace.IsMeasured());
  EXPECT_FALSE(audit.workspace.IsMeasured(0));
  EXPECT_TRUE(audit.workspace.IsMeasured(1));
  EXPECT_EQ(audit.decisions[0].compliance, Compliance::kPass);
  EXPECT_THAT(audit.decisions[0].reason,
              AllOf(HasSubstr("no pose was measured at the ends of the workspace in x ("),
                    Not(HasSubstr("y ("))));
  EXPECT_THAT(audit.decisions[1].reason, Not(HasSubstr("no pose was measured")));
}

TEST_F(AuditTest, WithoutARequirementNothingIsDecided) {
  const Audit audit = MakeAudit(example->Input(std::nullopt));
  EXPECT_EQ(audit.compliance, Compliance::kNotAsked);
  EXPECT_THAT(audit.decisions, IsEmpty());
  ASSERT_EQ(audit.points.size(), 1u);
  EXPECT_EQ(audit.points[0].point.name, "origin of frame T");
  EXPECT_FALSE(audit.workspace.is_stated);
  EXPECT_TRUE(audit.workspace.IsMeasured());
}

// A clean simulation: what is held out is as noise explains.
TEST_F(AuditTest, HeldOutPosesAreAsExpected) {
  const Audit audit = Make(5e-4);
  EXPECT_EQ(audit.held_out.poses, 60);
  EXPECT_GE(audit.held_out.inside, audit.held_out.fewest);
  EXPECT_GE(audit.held_out.fewest, 50);
  EXPECT_NEAR(audit.held_out.rms_position / audit.held_out.expected_position, 1.0, 0.15);
  EXPECT_FALSE(audit.global.is_too_large || audit.global.is_too_small);
}

// What was left out neither predicts nor counts: the figures are as if it had never been measured.
TEST_F(AuditTest, ARejectedPoseIsInNoFigureOfTheHeldOut) {
  testing::AuditedExample rejected = *example, never = *example;
  rejected.estimate.poses[7].weight = 0.0;
  never.estimate.poses.erase(never.estimate.poses.begin() + 7);
  never.observations.items.erase(never.observations.items.begin() + 7);
  const Audit audit = MakeAudit(rejected.Input(std::nullopt));
  const Audit expected = MakeAudit(never.Input(std::nullopt));
  EXPECT_EQ(audit.poses.size(), 60u);
  EXPECT_EQ(audit.held_out.poses, 59);
  EXPECT_EQ(audit.held_out.inside, expected.held_out.inside);
  EXPECT_NEAR(audit.held_out.rms_position / expected.held_out.rms_position, 1.0, 1e-9);
  EXPECT_NEAR(audit.held_out.expected_position / expected.held_out.expected_position, 1.0, 1e-9);
}

TEST_F(AuditTest, ColoursOfTheMapBeginAtZero) {
  const Audit audit = Make(5e-4);
  const Chart chart = MapChart(audit.points[0]);
  const auto& colours = chart.layout["coloraxis"];
  double largest = 0.0;
  for (const auto& height : audit.points[0].map.lengths)
    for (const auto& row : height)
      for (const double length : row)
        if (length > largest) largest = length;
  EXPECT_EQ(colours["cmin"], 0);
  EXPECT_NEAR(colours["cmax"].get<double>(), 1e3 * largest, 1e-9);  // without it cmin is ignored
}

// Three sigmas of one parameter, of a difference of two equal uncertainties.
TEST_F(AuditTest, ChangeIsInItsOwnStandardDeviations) {
  AuditInput input = example->Input(testing::ExampleRequirements());
  EarlierResult earlier;
  earlier.mounts = example->estimate.mounts;
  earlier.covariance = example->estimate.covariance;
  earlier.determined.fill(true);
  Vector6d step = Vector6d::Zero();
  step[1] = -3.0 * std::sqrt(2.0 * earlier.covariance(1, 1));
  earlier.mounts.world_from_base = Plus(earlier.mounts.world_from_base, step);
  input.earlier = earlier;
  const Audit audit = MakeAudit(input);
  ASSERT_TRUE(audit.change.has_value());
  EXPECT_NEAR(audit.change->sigmas[1], 3.0, 1e-6);
  EXPECT_NEAR(audit.change->sigmas[0], 0.0, 1e-6);
  EXPECT_GE(audit.change->chi_square, 9.0 - 1e-6);
  EXPECT_NEAR(audit.change->at_points[0], -step[1], 1e-9);
}

TEST_F(AuditTest, JsonSaysTheSame) {
  const Audit audit = Make(5e-4);
  const auto json = nlohmann::json::parse(AuditJson({{{"d.yaml", "00"}}, "11"}, audit));
  EXPECT_EQ(json["format"], "hexcal/audit/1");
  EXPECT_EQ(json["verdict"], "PASS");
  EXPECT_EQ(json["requirements"][0]["value"], audit.decisions[0].value);
  EXPECT_EQ(json["requirements"][0]["guard_band"], audit.decisions[0].guard);
  EXPECT_EQ(json["inputs"][0]["sha256"], "00");
  EXPECT_EQ(json["points"][0]["worst"]["length_95"], audit.points[0].worst.length_95);
  EXPECT_EQ(json["poses"].size(), 60u);
  EXPECT_TRUE(json["change"].is_null());
  EXPECT_EQ(json["held_out"]["coverage"]["inside"], audit.held_out.inside);
  EXPECT_EQ(json["held_out"]["coverage"]["low"], audit.held_out.coverage->limits.low);
  EXPECT_EQ(json["points"][0]["monte_carlo"]["coverage"]["of"], audit.points[0].check->draws);
  EXPECT_EQ(json["rows"][0]["input"], "robot poses");
  EXPECT_EQ(json["rows"][0]["used"], 60);
  EXPECT_EQ(json["rows"].size(), audit.rows.size());
  EXPECT_EQ(json["pose_design"]["ranges"][2][1], audit.design.span[2][1]);
  EXPECT_EQ(json["pose_design"]["angle_between_axes"], audit.design.angle_between_axes);
  EXPECT_EQ(json["linearized"]["solutions"][0]["name"], "paper");
  EXPECT_EQ(json["linearized"]["solutions"][0]["points"][0]["largest"],
            audit.linearity.solutions[0].points[0].largest);
  EXPECT_EQ(json["linearized"]["repeated"][11]["uncertainty_ratio"],
            audit.linearity.repeated[11].ratio);
}

}  // namespace
}  // namespace hexcal
