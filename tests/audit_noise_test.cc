// SPDX-License-Identifier: BSD-3-Clause
#include "report/audit_noise.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace hexcal {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

// Its markers' noise was not stated, and is three times as large along z.
Audit OfUnevenNoise() {
  Audit audit;
  audit.estimate.noise.estimated = true;
  audit.axis_noise = AxisNoise{
      Eigen::Vector3d(3e-5, 3e-5, 9e-5), 1e-3 * Eigen::Matrix3d::Identity(), /*ratio=*/100.0};
  return audit;
}

PointReport WithRepetitions(int inside_stated, bool exceeds_stated) {
  PointReport report;
  report.point.name = "tip";
  report.worst.length_95 = 2e-4;
  report.check = TargetCheck();
  report.check->draws = 1000;
  report.check->inside_stated = inside_stated;
  report.check->exceeds_stated = exceeds_stated;
  return report;
}

std::vector<std::string> DoubtsOf(const Audit& audit) {
  std::vector<std::string> doubts = {"an earlier one"};
  AddDoubtsOfNoise(audit, &doubts);
  EXPECT_EQ(doubts.front(), "an earlier one");
  doubts.erase(doubts.begin());
  return doubts;
}

TEST(AuditNoise, OfAxesThatDifferSaysWhatToState) {
  EXPECT_THAT(DoubtsOf(OfUnevenNoise()),
              ElementsAre(AllOf(HasSubstr("not alike along the tracker's axes"),
                                HasSubstr("scatter by 30 µm, 30 µm, 90 µm"))));
}

TEST(AuditNoise, OfAxesThatDifferByNothingThatShowsIsNoDoubt) {
  Audit audit = OfUnevenNoise();
  audit.axis_noise->sigma = Eigen::Vector3d(3e-5, 3e-5, 3.5e-5);
  EXPECT_THAT(DoubtsOf(audit), IsEmpty());
  audit = OfUnevenNoise();
  audit.axis_noise->likelihood_ratio = 1.0;  // chance has that
  EXPECT_THAT(DoubtsOf(audit), IsEmpty());
}

TEST(AuditNoise, OfAxesThatWereTakenAsTheyAreIsNoDoubt) {
  Audit audit = OfUnevenNoise();
  audit.estimate.noise.marker = audit.axis_noise->sigma;
  EXPECT_THAT(DoubtsOf(audit), IsEmpty());
  audit.axis_noise.reset();
  EXPECT_THAT(DoubtsOf(audit), IsEmpty());
}

TEST(AuditNoise, OfErrorsLongerThanStatedSaysHowManyAreNot) {
  Audit audit = OfUnevenNoise();
  audit.axis_noise.reset();
  audit.repeated.words = "1000 draws";
  audit.points = {WithRepetitions(950, false), WithRepetitions(812, true)};
  EXPECT_THAT(
      DoubtsOf(audit),
      ElementsAre(AllOf(HasSubstr("only 81.2 % of the repetitions (1000 draws)"),
                        HasSubstr("the error of tip within the 0.2 mm that"),
                        HasSubstr("state the noise of the measurement (measurement: noise)"))));
}

TEST(AuditNoise, OfErrorsLongerThanAStatedNoiseHasThemAsksForNoOther) {
  Audit audit = OfUnevenNoise();
  audit.axis_noise.reset();
  audit.estimate.noise.estimated = false;
  audit.points = {WithRepetitions(812, true)};
  EXPECT_THAT(DoubtsOf(audit), ElementsAre(Not(HasSubstr("state the noise"))));
}

}  // namespace
}  // namespace hexcal
