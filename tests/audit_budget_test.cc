// SPDX-License-Identifier: BSD-3-Clause
#include "report/audit_budget.h"

#include <gtest/gtest.h>

#include <cmath>

#include "config/units.h"
#include "testing/audits.h"

namespace hexcal {
namespace {

constexpr double kExact = 1e-12;

class AuditBudget : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    audit = new Audit(MakeAudit(testing::AuditExample().Input(MoreSources())));
  }
  static void TearDownTestSuite() { delete audit; }
  static const PointReport& Tip() { return audit->points.at(0); }

  // What the example states, and two sources more.
  static Requirements MoreSources() {
    Requirements requirements = testing::ExampleRequirements();
    StatedSource patient, drill;
    patient.source = {"patient", SourceSite::kWorld, 2e-4, 5e-4, Spread1d::kUniform, 12};
    drill.source = {"drill", SourceSite::kPoint, 3e-5};
    requirements.sources = {patient, drill};
    return requirements;
  }

  static const BudgetRow& RowOf(const Budget& budget, const std::string& label) {
    for (const BudgetRow& row : budget.rows)
      if (LabelOf(row) == label) return row;
    ADD_FAILURE() << "no row " << label;
    return budget.rows.front();
  }

  static void ExpectRow(const BudgetRow& row, double value, double divisor, double sensitivity) {
    EXPECT_NEAR(row.value / value, 1.0, kExact) << LabelOf(row);
    EXPECT_NEAR(row.divisor, divisor, kExact) << LabelOf(row);
    EXPECT_NEAR(row.sensitivity / sensitivity, 1.0, 1e-9) << LabelOf(row);
    EXPECT_NEAR(row.contribution / (sensitivity * value / divisor), 1.0, 1e-9) << LabelOf(row);
  }

  static Audit* audit;
};
Audit* AuditBudget::audit = nullptr;

// The squares of the contributions are the trace of the sum that TargetError makes of matrices.
TEST_F(AuditBudget, ContributionsMultiplyOutAndAddUp) {
  const PointReport& report = Tip();
  const TargetCovariance at =
      ErrorOf(*audit, report.point)
          .At(report.worst.place.base_from_platform, report.point.p_in_tool);
  ASSERT_EQ(report.budget.rows.size(), 7u);  // calibration, robot 2, patient 2, drill, the point
  double squares = 0.0, shares = 0.0;
  for (const BudgetRow& row : report.budget.rows) {
    EXPECT_NEAR(row.contribution, row.sensitivity * row.value / row.divisor, 1e-18) << row.name;
    squares += row.contribution * row.contribution;
    shares += row.share;
  }
  EXPECT_NEAR(squares / at.total.trace(), 1.0, 1e-9);
  EXPECT_NEAR(shares, 1.0, 1e-9);
  EXPECT_NEAR(squares, report.worst.rms * report.worst.rms, 1e-9 * squares);
}

// By hand: an error along each of three axes is sqrt 3 as long as along one; a rotation about
// axes of equal uncertainty moves a point by sqrt 2 times its distance from where they cross.
TEST_F(AuditBudget, SensitivitiesAreThoseOfTheLevers) {
  const PointReport& report = Tip();
  const BaseAndTool& mounts = audit->estimate.mounts;
  const Eigen::Vector3d p_in_platform = mounts.platform_from_tool * report.point.p_in_tool;
  const Eigen::Vector3d p_in_world =
      mounts.world_from_base * (report.worst.place.base_from_platform * p_in_platform);
  const double root3 = std::sqrt(3.0), root2 = std::sqrt(2.0);
  const Budget& budget = report.budget;
  ExpectRow(RowOf(budget, "robot's own error: position"), 5e-6, 1.0, root3);
  ExpectRow(RowOf(budget, "robot's own error: orientation"),
            0.002 * kPi / 180.0,
            1.0,
            root2 * p_in_platform.norm());
  // A half width is sqrt 3 standard deviations of its rectangle.
  ExpectRow(RowOf(budget, "patient: position"), root3 * 2e-4, root3, root3);
  ExpectRow(RowOf(budget, "patient: orientation"), root3 * 5e-4, root3, root2 * p_in_world.norm());
  ExpectRow(RowOf(budget, "drill: position"), 3e-5, 1.0, root3);
  ExpectRow(RowOf(budget, "the point in frame T: position"), 2e-5, 1.0, root3);
  EXPECT_EQ(RowOf(budget, "patient: position").spread, BudgetSpread::kRectangular);
  EXPECT_EQ(RowOf(budget, "patient: orientation").degrees_of_freedom, 12.0);
  EXPECT_EQ(RowOf(budget, "drill: position").type, 'B');
}

// By hand: a small motion of a mount shifts the point as far, and turns it by its distance from
// the axis.
TEST_F(AuditBudget, NumbersOfTheCalibrationAreCarriedByTheirLevers) {
  const PointReport& report = Tip();
  const BaseAndTool& mounts = audit->estimate.mounts;
  const Eigen::Vector3d p_in_base =
      report.worst.place.base_from_platform * (mounts.platform_from_tool * report.point.p_in_tool);
  const std::vector<ParameterRow>& rows = report.budget.parameters;
  ASSERT_EQ(rows.size(), 12u);
  double shares = report.budget.correlations;
  for (int i = 0; i < 12; ++i) {
    const Eigen::Vector3d& lever = i < 6 ? p_in_base : report.point.p_in_tool;
    const double by_hand = i % 6 < 3 ? 1.0 : Eigen::Vector3d::Unit(i % 3).cross(lever).norm();
    EXPECT_NEAR(rows[i].sensitivity, by_hand, 1e-9) << rows[i].name;
    EXPECT_EQ(rows[i].unit, i % 6 < 3 ? "m" : "rad");
    EXPECT_NEAR(rows[i].value / std::sqrt(audit->estimate.covariance(i, i)), 1.0, 1e-6);
    EXPECT_NEAR(rows[i].contribution, rows[i].sensitivity * rows[i].value, 1e-18);
    shares += rows[i].share;
  }
  EXPECT_NEAR(shares, 1.0, 1e-9);
}

// The last row is twice the sum over the pairs (JCGM 100:2008, eq. 16).
TEST_F(AuditBudget, CorrelationsAreTheSumOverPairs) {
  const PointReport& report = Tip();
  const auto j = TargetJacobian(
      audit->estimate.mounts, report.worst.place.base_from_platform, report.point.p_in_tool);
  double pairs = 0.0;
  for (int a = 0; a < 12; ++a)
    for (int b = 0; b < a; ++b)
      pairs += 2.0 * j.col(a).dot(j.col(b)) * audit->estimate.covariance(a, b);
  const double total = (j * audit->estimate.covariance * j.transpose()).trace();
  EXPECT_NEAR(report.budget.correlations, pairs / total, 1e-6);
}

// Whoever states the noise has evaluated it otherwise than by these observations.
TEST_F(AuditBudget, CalibrationIsOfTheTypeOfItsNoise) {
  EXPECT_EQ(Tip().budget.rows[0].type, 'B');
  EXPECT_EQ(Tip().budget.rows[0].spread, BudgetSpread::kNormal);
  Audit told = *audit;
  told.estimate.noise.estimated = true;
  told.estimate.intervals = IntervalsOfScaledNoise(told.estimate.covariance, 60.0);
  const Budget budget = BudgetOf(told, Tip().point, Tip().worst.place.base_from_platform);
  EXPECT_EQ(budget.rows[0].type, 'A');
  EXPECT_EQ(budget.rows[0].spread, BudgetSpread::kStudent);
  EXPECT_NEAR(budget.rows[0].degrees_of_freedom, 60.0, 1e-9);
  EXPECT_NEAR(budget.parameters[0].degrees_of_freedom, 60.0, 1e-9);
}

// The same rule for a tip by pivoting.
TEST_F(AuditBudget, APivotingIsOfTheTypeOfItsNoise) {
  NamedPoint tip = Tip().point;
  tip.pivot = PivotPoint{};
  tip.pivot->covariance = 1e-10 * Eigen::Matrix3d::Identity();
  const auto row = [&] {
    return BudgetOf(*audit, tip, Tip().worst.place.base_from_platform).rows.back();
  };
  EXPECT_EQ(row().type, 'B');
  EXPECT_EQ(row().spread, BudgetSpread::kNormal);
  tip.pivot->degrees_of_freedom = 50.0;
  EXPECT_EQ(row().type, 'A');
  EXPECT_EQ(row().spread, BudgetSpread::kStudent);
}

}  // namespace
}  // namespace hexcal
