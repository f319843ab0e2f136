// SPDX-License-Identifier: BSD-3-Clause
// Repetition of the fit that was made, where it is not the weighted least-squares one.
#include "estimator/pose_repetition.h"

#include <gtest/gtest.h>

#include <cmath>

#include "testing/scenes.h"

namespace hexcal {
namespace {

using testing::SeededByTest;

const Matrix6d kNoise = 1e-2 * testing::TrackerLikeCovariance();

// The base near the world, as the paper's iteration needs it.
template <typename Rng>
Observations Measured(Rng& rng, int poses, const Matrix6d& noise = kNoise) {
  const BaseAndTool truth = {testing::SmallPose(rng, 0.1, 0.1), testing::SmallPose(rng, 0.1, 0.2)};
  std::vector<Observation> rows = testing::HexapodObservations(rng, truth, poses);
  testing::AddNoise(rng, noise, &rows);
  return testing::KnownNoise(rows, noise);
}

MonteCarloOptions Draws(int draws) {
  MonteCarloOptions options;
  options.draws = draws;
  options.keep_draws = true;
  return options;
}

// Of all 12 together: d' S^-1 d / 12 over the draws, which is 1 +- sqrt(1 / (6 draws)).
double Spread(const FitPropagation& propagation, const Matrix12d& covariance) {
  const Eigen::MatrixXd& draws = propagation.check.estimates;
  double sum = 0.0;
  for (Eigen::Index k = 0; k < draws.cols(); ++k)
    sum += draws.col(k).dot(covariance.llt().solve(draws.col(k)));
  return sum / (12.0 * static_cast<double>(draws.cols()));
}

TEST(PoseRepetition, VarianceUnderTheDefaultLossesIsThatOf95PercentEfficiency) {
  EXPECT_EQ(VarianceUnderLoss({}), 1.0);
  for (const LossKind kind : {LossKind::kHuber, LossKind::kCauchy, LossKind::kTukey})
    EXPECT_NEAR(0.95 * VarianceUnderLoss(DefaultLoss(kind)), 1.0, 1e-3);
}

// At a quarter of its scale Tukey's loss throws most of what the poses say away: least squares
// repeated would not show it.
TEST(PoseRepetition, RepeatsTheLossWithItsOwnEfficiency) {
  auto rng = SeededByTest();
  const Observations observations = Measured(rng, 60);
  for (const RobustLoss& loss :
       {DefaultLoss(LossKind::kHuber), RobustLoss{LossKind::kTukey, 3.5}}) {
    RepeatedFit fit;
    fit.options.loss = loss;
    const Estimate estimate = Calibrate(observations, {}, fit.options);
    const FitPropagation repeated =
        CheckFitPropagation(observations, {}, estimate, fit, Draws(3000));
    ASSERT_TRUE(repeated.check.done) << repeated.check.why_not;
    const FitPropagation plain = CheckFitPropagation(observations, {}, estimate, {}, Draws(600));
    const double variance = VarianceUnderLoss(loss);
    EXPECT_NEAR(Spread(repeated, repeated.first_order), 1.0, 0.12);  // first order in 1 / poses
    EXPECT_NEAR(Spread(repeated, plain.first_order) / variance, 1.0, 0.12);
    EXPECT_NEAR(Spread(plain, plain.first_order), 1.0, 0.06);
    // The loss at work on these data, too: what the estimate states is of the same size.
    EXPECT_NEAR(estimate.covariance.trace() / repeated.first_order.trace(), 1.0, 0.4);
  }
  EXPECT_GT(VarianceUnderLoss({LossKind::kTukey, 3.5}), 1.5);
}

// Draw by draw the fit ends where the linear estimator does, the tracker's own common error in
// both: a spread alone would not show a sign.
TEST(PoseRepetition, ADrawMovesTheFitAsTheLinearEstimatorSays) {
  auto rng = SeededByTest();
  Observations observations = Measured(rng, 20);
  observations.tracker_from_world = Pose3d{};
  observations.tracker_from_world_covariance = kNoise;
  const NoiseLevels levels;
  Estimate estimate;
  estimate.mounts = Calibrate(Measured(rng, 20), {}, {}).mounts;
  const PoseRepetition repetition(observations, levels, estimate, {});
  const Repetition::Block block = repetition.Run(10, 1, 0);
  EXPECT_EQ(block.not_converged, 0);
  ASSERT_GT(block.linear.norm(), 1e-9);
  for (int k = 0; k < 10; ++k)
    EXPECT_LT((block.estimator.col(k) - block.linear.col(k)).norm(),
              1e-2 * block.linear.col(k).norm());
}

// Where the noise is so large that the linear estimator is not the fit, its steps end where another
// solver does: of the same draws under a loss that counts everything.
TEST(PoseRepetition, ItsLeastSquaresEndWhereTheNonlinearSolverDoes) {
  auto rng = SeededByTest();
  const Matrix6d noise = 1e4 * kNoise;
  const Observations observations = Measured(rng, 20, noise);
  const NoiseLevels levels;
  const Estimate estimate = Calibrate(observations, {}, {});
  RepeatedFit other;
  other.options.loss = {LossKind::kHuber, 1e6};
  const Eigen::MatrixXd steps =
      PoseRepetition(observations, levels, estimate, {}).Run(10, 1, 0).estimator;
  const Repetition::Block solved =
      PoseRepetition(observations, levels, estimate, other).Run(10, 1, 0);
  EXPECT_LT((steps - solved.estimator).norm(), 1e-4 * steps.norm());
  EXPECT_GT((solved.linear - solved.estimator).norm(), 1e-3 * steps.norm());
}

TEST(PoseRepetition, RepeatsThePapersIterationWithItsOwnCovariance) {
  auto rng = SeededByTest();
  const Observations observations = Measured(rng, 30);
  RepeatedFit fit;
  fit.options.solver = Solver::kLinearized;
  fit.options.linearized.error = LinearizedOptions::Error::kPaper;
  fit.options.linearized.max_iterations = 100;
  fit.initial = BaseAndTool{};
  const Estimate paper = Calibrate(observations, fit.initial, fit.options);
  ASSERT_TRUE(paper.IsTrustworthy()) << paper.message;
  const FitPropagation repeated = CheckFitPropagation(observations, {}, paper, fit, Draws(2500));
  ASSERT_TRUE(repeated.check.done);
  EXPECT_LT((repeated.first_order - paper.covariance_unscaled).norm(),
            0.02 * paper.covariance_unscaled.norm());
  EXPECT_NEAR(Spread(repeated, repeated.first_order), 1.0, 0.08);
  const FitPropagation plain = CheckFitPropagation(observations, {}, paper, {}, Draws(600));
  EXPECT_GT(Spread(repeated, plain.first_order), 1.2);  // equal weights are less certain
  EXPECT_EQ(repeated.check.not_converged, 0);
}

// Some iterations, and a tolerance that these data just meet with them: others do not. A plain
// nonlinear fit always arrives.
TEST(PoseRepetition, CountsIterationsThatDoNotArrive) {
  auto rng = SeededByTest();
  const Observations observations = Measured(rng, 12, testing::TrackerLikeCovariance());
  RepeatedFit fit;
  fit.options.solver = Solver::kLinearized;
  fit.options.linearized.error = LinearizedOptions::Error::kPaper;
  fit.options.linearized.max_iterations = 25;
  fit.initial = BaseAndTool{};
  double log_low = std::log(1e-14), log_high = std::log(1e-4);
  for (int k = 0; k < 40; ++k) {
    const double middle = 0.5 * (log_low + log_high);
    fit.options.linearized.tolerance = std::exp(middle);
    const bool arrives = Calibrate(observations, fit.initial, fit.options).converged;
    (arrives ? log_high : log_low) = middle;
  }
  fit.options.linearized.tolerance = std::exp(log_high);
  const Estimate just = Calibrate(observations, fit.initial, fit.options);
  ASSERT_TRUE(just.converged);
  const FitPropagation repeated = CheckFitPropagation(observations, {}, just, fit, Draws(2500));
  ASSERT_TRUE(repeated.check.done);
  EXPECT_GT(repeated.check.not_converged, 0);
  EXPECT_LT(repeated.check.not_converged, repeated.check.draws);
  EXPECT_EQ(CheckFitPropagation(observations, {}, just, {}, Draws(500)).check.not_converged, 0);
}

}  // namespace
}  // namespace hexcal
