// SPDX-License-Identifier: BSD-3-Clause
// Score tests of forms against explicit least squares, quadrature and repeats.
#include "discovery/score.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "discovery/family_wise.h"
#include "discovery/log_tail.h"
#include "estimator/quantiles.h"
#include "geometry/linear_algebra.h"
#include "testing/random.h"

namespace hexcal {
namespace {

using ::hexcal::testing::Normal;
using ::hexcal::testing::SeededByTest;

constexpr int kPoses = 30, kNuisances = 12;

template <typename Rng>
Eigen::MatrixXd NormalMatrix(Rng& rng, int rows, int columns) {
  Eigen::MatrixXd m(rows, columns);
  for (int k = 0; k < columns; ++k) m.col(k) = Normal(rng, rows);
  return m;
}

// Unit noise, random columns: forms of 1, 3 and 1 columns, the last one a combination of nuisances.
template <typename Rng>
LinearProblem MakeProblem(Rng& rng) {
  LinearProblem problem;
  problem.poses = kPoses;
  problem.error = Normal(rng, 6 * kPoses);
  problem.nuisance = NormalMatrix(rng, 6 * kPoses, kNuisances);
  Eigen::MatrixXd columns = NormalMatrix(rng, 6 * kPoses, 5);
  columns.col(4) = problem.nuisance * Normal(rng, kNuisances);
  problem.columns = std::make_shared<Eigen::MatrixXd>(columns);
  problem.shape_columns = std::make_shared<Eigen::MatrixXd>(0, 0);
  problem.shape_nuisance.resize(0, kNuisances);
  problem.shape_of.assign(5, -1);
  problem.components = {std::vector<Matrix6d>(kPoses, Matrix6d::Identity())};
  problem.scale = Eigen::VectorXd::LinSpaced(5, 0.5, 2.0);
  for (const auto& [first, size] : {std::pair(0, 1), std::pair(1, 3), std::pair(4, 1)}) {
    Form form;
    form.family = static_cast<int>(problem.families.size());
    form.first = first, form.size = size;
    problem.forms.push_back(form);
    problem.families.push_back({"family", 0.0, false});
  }
  return problem;
}

GapNoise UnitNoise(int poses = kPoses) {
  GapNoise noise;
  noise.factor = {1.0};
  noise.weight = noise.shape_weight = Eigen::VectorXd::Ones(poses);
  return noise;
}

double SquaresLeft(const Eigen::MatrixXd& a, const Eigen::VectorXd& b) {
  return (b - a * ShortestSolution(a, b, 1e-12)).squaredNorm();
}

TEST(Score, GainIsTheFallOfTheSquaresInAFullFit) {
  auto rng = SeededByTest();
  const LinearProblem problem = MakeProblem(rng);
  const Scorer scorer(problem, UnitNoise());
  const double alone = SquaresLeft(problem.nuisance, problem.error);
  EXPECT_NEAR(scorer.squared_residual(), alone, 1e-9);
  EXPECT_EQ(scorer.freedom(), 6 * kPoses - kNuisances);
  for (const int f : {0, 1}) {
    const Score& score = scorer.scores()[f];
    const double with = SquaresLeft(problem.With({f}).nuisance, problem.error);
    EXPECT_NEAR(score.gain, alone - with, 1e-9);
    EXPECT_EQ(score.rank, problem.forms[f].size);
    const double freedom = scorer.freedom() - score.rank;
    const double ratio = (alone - with) / score.rank / (with / freedom);
    EXPECT_NEAR(score.log10_p, std::log10(FisherFTail(ratio, score.rank, freedom)), 1e-9);
  }
}

TEST(Score, WhatNuisancesExplainHasRankZero) {
  auto rng = SeededByTest();
  const Scorer scorer(MakeProblem(rng), UnitNoise());
  EXPECT_EQ(scorer.scores()[2].rank, 0);
  for (const auto& family : scorer.Families()) EXPECT_NE(family.family, 2);
}

TEST(Score, GivenFormsAreNuisances) {
  auto rng = SeededByTest();
  const LinearProblem problem = MakeProblem(rng);
  GapNoise noise = UnitNoise();
  noise.factor[0] = 1.7;
  // The second explains itself away; the third is a combination of nuisances, and adds nothing.
  const Scorer given = Scorer(problem, noise).Given({1, 2});
  const Scorer with(problem.With({1, 2}), noise);
  EXPECT_EQ(given.freedom(), with.freedom());
  EXPECT_NEAR(given.squared_residual(), with.squared_residual(), 1e-9);
  ASSERT_EQ(given.scores().size(), with.scores().size());
  for (const int f : {0, 1, 2}) {
    EXPECT_EQ(given.scores()[f].rank, with.scores()[f].rank);
    EXPECT_EQ(given.scores()[f].rank, f == 0 ? 1 : 0);
    EXPECT_NEAR(given.scores()[f].gain, with.scores()[f].gain, 1e-9);
    EXPECT_NEAR(given.scores()[f].evidence, with.scores()[f].evidence, 1e-9);
    EXPECT_NEAR(given.scores()[f].log10_p, with.scores()[f].log10_p, 1e-9);
  }
  EXPECT_LT((given.Coefficients(0, 0.0) - with.Coefficients(0, 0.0)).norm(), 1e-9);
}

TEST(Score, EvidenceIsTheIntegralOverThePrior) {
  auto rng = SeededByTest();
  const LinearProblem problem = MakeProblem(rng);
  const Scorer scorer(problem, UnitNoise());
  const Eigen::MatrixXd basis = OrthonormalBasis(problem.nuisance, 1e-10);
  const auto project = [&](const Eigen::VectorXd& v) -> Eigen::VectorXd {
    return v - basis * (basis.transpose() * v);
  };
  const Eigen::VectorXd r = project(problem.error), g = project(problem.columns->col(0));
  // Mean over five widths of the prior of the integral of the likelihood ratio, by the rectangle
  // rule.
  double sum = 0.0;
  for (const double width : {0.3, 1.0, 3.0, 10.0, 30.0}) {
    const double sigma = width * problem.scale[0], step = std::min(0.002, sigma / 50.0);
    for (double c = -4.0; c <= 4.0; c += step) {
      const double ratio = std::exp(c * g.dot(r) - 0.5 * c * c * g.squaredNorm());
      sum += ratio * std::exp(-0.5 * c * c / (sigma * sigma)) / (sigma * std::sqrt(2.0 * M_PI)) *
             step / 5.0;
    }
  }
  EXPECT_NEAR(scorer.scores()[0].evidence, 2.0 * std::log(sum), 1e-3);
}

TEST(Score, CoefficientsAndTheirCovarianceAreTheFullFits) {
  auto rng = SeededByTest();
  const LinearProblem problem = MakeProblem(rng);
  const Scorer scorer(problem, UnitNoise());
  const Eigen::MatrixXd all = problem.With({1}).nuisance;
  const Eigen::VectorXd x = ShortestSolution(all, problem.error, 1e-12);
  EXPECT_TRUE(scorer.Coefficients(1, 0.0).isApprox(x.tail(3), 1e-9));
  const Eigen::MatrixXd covariance = PseudoInverse(all.transpose() * all, 1e-12);
  EXPECT_TRUE(scorer.CoefficientCovariance(1).isApprox(covariance.bottomRightCorner(3, 3), 1e-9));
  // A narrow prior pulls towards zero.
  EXPECT_LT(scorer.Coefficients(1, 1e-3).norm(), 1e-2 * x.tail(3).norm());
}

TEST(Score, ExplainedIsOneForTheSameAndTheCosineSquaredElse) {
  auto rng = SeededByTest();
  LinearProblem problem = MakeProblem(rng);
  Eigen::MatrixXd columns = *problem.columns;
  columns.col(4) = 3.0 * columns.col(0) + problem.nuisance.col(2);
  problem.columns = std::make_shared<Eigen::MatrixXd>(columns);
  const Scorer scorer(problem, UnitNoise());
  EXPECT_NEAR(scorer.Explained(0, 2), 1.0, 1e-9);
  EXPECT_NEAR(scorer.Explained(0, 0), 1.0, 1e-9);
  EXPECT_LT(scorer.Explained(0, 1), 0.3);
  EXPECT_GT(scorer.Explained(0, 1), 0.0);
}

TEST(Score, UnequalNoiseIsWhitenedFirst) {
  auto rng = SeededByTest();
  LinearProblem problem = MakeProblem(rng);
  const Scorer plain(problem, UnitNoise());
  // The same problem with everything in pose 3 scaled by a matrix, and its covariance with it.
  Matrix6d scale = Matrix6d::Identity() + 0.3 * NormalMatrix(rng, 6, 6);
  problem.error.segment<6>(18) = scale * problem.error.segment<6>(18).eval();
  problem.nuisance.middleRows<6>(18) = scale * problem.nuisance.middleRows<6>(18).eval();
  Eigen::MatrixXd columns = *problem.columns;
  columns.middleRows<6>(18) = scale * columns.middleRows<6>(18).eval();
  problem.columns = std::make_shared<Eigen::MatrixXd>(columns);
  problem.components[0][3] = scale * scale.transpose();
  const Scorer scaled(problem, UnitNoise());
  EXPECT_NEAR(scaled.scores()[1].gain, plain.scores()[1].gain, 1e-8);
}

TEST(Log10FisherTail, MeetsTheLibrarysAndGoesOnBelowIt) {
  for (const double f : {0.5, 2.0, 10.0, 60.0})
    EXPECT_NEAR(Log10FisherTail(f, 3.0, 400.0), std::log10(FisherFTail(f, 3.0, 400.0)), 1e-10);
  EXPECT_EQ(Log10FisherTail(0.0, 3.0, 400.0), 0.0);
  // Two numerator degrees of freedom have a closed form: (1 + 2 f / n)^(-n / 2).
  for (const double f : {10.0, 1e3, 1e5})
    EXPECT_NEAR(Log10FisherTail(f, 2.0, 600.0), -300.0 * std::log10(1.0 + 2.0 * f / 600.0), 1e-6);
  EXPECT_LT(Log10FisherTail(5000.0, 1.0, 5000.0), -700.0);
}

TEST(FamilyWise, NoiseAloneLooksAsGoodAsItShould) {
  auto rng = SeededByTest();
  constexpr int kSets = 200;
  int below = 0;
  for (int i = 0; i < kSets; ++i) {
    const LinearProblem problem = MakeProblem(rng);
    const Scorer scorer(problem, UnitNoise());
    const FamilyWise null(scorer, 199, 7 + i);
    double best = 0.0;
    for (const auto& family : scorer.Families())
      best = std::max(best, null.Paid(family.family, -family.log10_p));
    if (null.PValue(best) <= 0.2) ++below;
  }
  // 200 draws at 0.2: 40 +- 5.7.
  EXPECT_GT(below, 22);
  EXPECT_LT(below, 60);
}

TEST(FamilyWise, PaysForTheSearchAndKeepsItsDigits) {
  auto rng = SeededByTest();
  const LinearProblem problem = MakeProblem(rng);
  const FamilyWise null(Scorer(problem, UnitNoise()), 499, 1);
  EXPECT_LE(null.Paid(0, 3.0), 3.0 + 1e-9);
  EXPECT_GT(null.PValue(1.0), null.PValue(2.0));
  EXPECT_LT(null.PValue(40.0), 1e-38);
  EXPECT_GT(null.PValue(0.0), 0.9);
}

}  // namespace
}  // namespace hexcal
