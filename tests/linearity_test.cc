// SPDX-License-Identifier: BSD-3-Clause
#include "report/linearity.h"

#include <gtest/gtest.h>

#include <cmath>

#include "estimator/target_error.h"
#include "testing/audits.h"

namespace hexcal {
namespace {

class LinearityTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    example = new testing::AuditedExample(testing::AuditExample());
    audit = new Audit(MakeAudit(example->Input(testing::ExampleRequirements())));
  }
  static void TearDownTestSuite() {
    delete audit;
    delete example;
  }

  static const LinearizedSolution& Of(const std::string& name) {
    for (const LinearizedSolution& solution : audit->linearity.solutions)
      if (solution.name == name) return solution;
    throw std::runtime_error("no " + name);
  }

  static testing::AuditedExample* example;
  static Audit* audit;
};
testing::AuditedExample* LinearityTest::example = nullptr;
Audit* LinearityTest::audit = nullptr;

// The comparison of methods has fitted the same, by another way.
TEST_F(LinearityTest, DifferencesAreThoseOfTheComparison) {
  for (const MethodResult& method : audit->comparison.methods) {
    if (method.method != Method::kPaper && method.method != Method::kTwist) continue;
    const LinearizedSolution& solution = Of(std::string(InfoOf(method.method).name));
    EXPECT_LT((solution.over_u - method.sigmas).cwiseAbs().maxCoeff(), 1e-6) << solution.name;
    EXPECT_TRUE(solution.estimate.converged);
  }
}

// The twist iteration solves the nonlinear problem; equal weights cost certainty.
TEST_F(LinearityTest, TwistEndsAtTheNonlinearSolutionAndEqualWeightsAreNoBetter) {
  EXPECT_LT(Of("twist").over_u.cwiseAbs().maxCoeff(), 1e-3);
  EXPECT_LT((Of("twist").ratio.array() - 1.0).abs().maxCoeff(), 1e-6);
  EXPECT_NEAR(Of("twist").points[0].ratio, 1.0, 1e-6);
  EXPECT_GT(Of("paper").over_u.cwiseAbs().maxCoeff(), 0.01);
  EXPECT_GT(Of("paper").ratio.minCoeff(), 1.0 - 1e-6);  // Gauss and Markov
  EXPECT_GT(Of("paper").points[0].ratio, 1.0);
}

// A small difference of the parameters moves a point by its Jacobian, to first order: base and tool
// move it to and fro by far more than what is left.
TEST_F(LinearityTest, PointsAreOffByWhatTheParametersAreOffBy) {
  const Estimate& nonlinear = audit->comparison.reference;
  const LinearizedSolution& paper = Of("paper");
  const NamedPoint& tip = audit->requirements.points[0];
  const Vector12d difference =
      paper.over_u.cwiseProduct(nonlinear.covariance.diagonal().cwiseSqrt());
  const auto jacobian = TargetJacobian(
      nonlinear.mounts, audit->points[0].centre.place.base_from_platform, tip.p_in_tool);
  const double expected = (jacobian * difference).norm();
  EXPECT_GT(expected, 1e-8);
  EXPECT_NEAR(paper.points[0].centre / expected, 1.0, 0.01);
  EXPECT_GE(paper.points[0].largest, paper.points[0].centre);
}

// Of 1000 draws, a ratio is known to 2 % and a coverage to 0.7 %.
TEST_F(LinearityTest, RepetitionConfirmsUncertaintyAndCoverage) {
  ASSERT_EQ(audit->linearity.repeated.size(), 12u);
  int holds = 0;
  for (const RepeatedParameter& parameter : audit->linearity.repeated) {
    EXPECT_NEAR(parameter.ratio, 1.0, 0.1);
    EXPECT_EQ(parameter.coverage.of, audit->comparison.propagation.draws);
    EXPECT_NEAR(parameter.coverage.Share(), 0.95, 0.03);
    holds += parameter.coverage.HoldsNominal();
  }
  EXPECT_GE(holds, 9);
}

TEST_F(LinearityTest, HeldOutPosesAndPointsHaveTheirCoverage) {
  const HeldOutTest& held = audit->held_out;
  ASSERT_TRUE(held.coverage.has_value());
  EXPECT_EQ(held.coverage->inside, held.inside);
  EXPECT_EQ(held.coverage->of, 60);
  EXPECT_TRUE(held.coverage->HoldsNominal());
  EXPECT_TRUE(CoverageOf(audit->points[0].check->inside, audit->points[0].check->draws, 0.95)
                  .HoldsNominal());
}

// 50 of 60: 71.5 to 91.7 % (tables of the binomial distribution).
TEST(Coverage, SaysWhetherSoManyHoldTheNominalShare) {
  const Coverage few = CoverageOf(50, 60, 0.95);
  EXPECT_FALSE(few.HoldsNominal());
  EXPECT_EQ(CoverageText(few), "83.3 % (71.5 to 91.7 %)");
  EXPECT_TRUE(CoverageOf(57, 60, 0.95).HoldsNominal());
}

}  // namespace
}  // namespace hexcal
