// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/calibrate.h"

#include <algorithm>

#include "estimator/polish.h"
#include "residuals/whitener.h"
#include "testing/matchers.h"
#include "testing/scenes.h"

namespace hexcal {
namespace {

using testing::AnyMounts;
using testing::Difference;
using testing::HexapodObservations;
using testing::MatrixNear;
using testing::PoseNear;
using testing::SeededByTest;
using testing::TrackerLikeCovariance;

CalibrateOptions Linearized(LinearizedOptions::Error error) {
  CalibrateOptions options;
  options.solver = Solver::kLinearized;
  options.linearized.error = error;
  return options;
}

TEST(Calibrate, RecoversAThousandBasesAndToolsFromNothing) {
  auto rng = SeededByTest();
  double worst = 0.0;
  for (int i = 0; i < 1000; ++i) {
    const BaseAndTool truth = AnyMounts(rng);
    const Estimate estimate =
        Calibrate(testing::UnknownNoise(HexapodObservations(rng, truth, 10)), {}, {});
    ASSERT_TRUE(estimate.IsTrustworthy()) << i << " " << estimate.message;
    worst = std::max(worst, Difference(estimate.mounts, truth).cwiseAbs().maxCoeff());
  }
  EXPECT_LT(worst, 1e-9);
}

TEST(Calibrate, ThePapersDataComeOutToTwelveDigits) {
  const Estimate estimate = Calibrate(testing::UnknownNoise(testing::PaperObservations()), {}, {});
  EXPECT_TRUE(estimate.IsTrustworthy());
  EXPECT_LT(Difference(estimate.mounts, testing::PaperMounts()).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LT(estimate.rmspe, 1e-12);
}

TEST(Calibrate, TwistIterationAndCeresAgree) {
  auto rng = SeededByTest();
  for (const bool known : {true, false}) {
    const BaseAndTool truth = AnyMounts(rng);
    auto rows = HexapodObservations(rng, truth, 30);
    testing::AddNoise(rng, TrackerLikeCovariance(), &rows);
    const Observations observations =
        known ? testing::KnownNoise(rows, TrackerLikeCovariance()) : testing::UnknownNoise(rows);
    const Estimate ceres = Calibrate(observations, {}, {});
    CalibrateOptions twist = Linearized(LinearizedOptions::Error::kTwist);
    twist.start = Start::kClosedForm;
    twist.linearized.max_iterations = 200;
    const Estimate iterated = Calibrate(observations, {}, twist);
    ASSERT_TRUE(ceres.converged && iterated.converged);
    // J is exact at a perfect fit only: with noise the two differ by far less than a standard
    // deviation.
    const Vector12d sigma = ceres.covariance.diagonal().cwiseSqrt();
    const Vector12d off = Difference(iterated.mounts, ceres.mounts).cwiseQuotient(sigma);
    EXPECT_LT(off.cwiseAbs().maxCoeff(), 0.02);
    EXPECT_NEAR(iterated.chi_square / ceres.chi_square, 1.0, 1e-4);
    EXPECT_TRUE(MatrixNear(
        iterated.covariance.diagonal().cwiseSqrt().cwiseQuotient(sigma), Vector12d::Ones(), 0.01));
  }
}

// The equally weighted estimator's covariance is the spread of that estimator, not of the best one.
TEST(Calibrate, ThePapersErrorReportsTheSpreadOfItsOwnEstimates) {
  auto rng = SeededByTest();
  const BaseAndTool truth = testing::PaperMounts();
  const auto exact = HexapodObservations(rng, truth, 20);
  CalibrateOptions options = Linearized(LinearizedOptions::Error::kPaper);
  options.linearized.tolerance = 1e-9;
  Vector6d unequal;  // m^2, rad^2: equal weights are far from the best
  unequal << Eigen::Vector3d::Constant(4e-10), Eigen::Vector3d::Constant(1e-6);
  const int draws = 1500;
  Matrix12d spread = Matrix12d::Zero(), reported = Matrix12d::Zero();
  for (int i = 0; i < draws; ++i) {
    auto rows = exact;
    testing::AddNoise(rng, unequal.asDiagonal(), &rows);
    const Estimate estimate = Calibrate(testing::UnknownNoise(rows), {}, options);
    ASSERT_TRUE(estimate.converged) << estimate.message;
    const Vector12d d = Difference(estimate.mounts, truth);
    spread += d * d.transpose() / draws;
    reported += estimate.covariance / draws;
  }
  for (int i = 0; i < 12; ++i)
    EXPECT_NEAR(std::sqrt(spread(i, i) / reported(i, i)), 1.0, 0.07) << kParameters[i].name;
}

TEST(Calibrate, DoesNotDependOnTheOrderOfRows) {
  auto rng = SeededByTest();
  const BaseAndTool truth = AnyMounts(rng);
  auto rows = HexapodObservations(rng, truth, 40);
  testing::AddNoise(rng, TrackerLikeCovariance(), &rows);
  const Estimate before = Calibrate(testing::UnknownNoise(rows), {}, {});
  std::shuffle(rows.begin(), rows.end(), rng);
  const Estimate after = Calibrate(testing::UnknownNoise(rows), {}, {});
  EXPECT_LT(Difference(after.mounts, before.mounts).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_TRUE(MatrixNear(after.covariance / before.covariance.diagonal().maxCoeff(),
                         before.covariance / before.covariance.diagonal().maxCoeff(),
                         1e-9));
}

// Another world frame moves the base by itself and leaves the tool and the whole covariance as they
// are.
TEST(Calibrate, AnotherWorldFrameMovesTheBaseAlone) {
  auto rng = SeededByTest();
  const BaseAndTool truth = AnyMounts(rng);
  auto rows = HexapodObservations(rng, truth, 40);
  testing::AddNoise(rng, TrackerLikeCovariance(), &rows);
  const Estimate before = Calibrate(testing::UnknownNoise(rows), {}, {});
  const Pose3d other_from_world = testing::RandomPose(rng, 3.0);
  for (Observation& o : rows) o.world_from_tool = other_from_world * o.world_from_tool;
  const Estimate after = Calibrate(testing::UnknownNoise(rows), {}, {});
  EXPECT_TRUE(PoseNear(
      after.mounts.world_from_base, other_from_world * before.mounts.world_from_base, 1e-9, 1e-9));
  EXPECT_TRUE(
      PoseNear(after.mounts.platform_from_tool, before.mounts.platform_from_tool, 1e-9, 1e-9));
  EXPECT_TRUE(MatrixNear(after.covariance / before.covariance.diagonal().maxCoeff(),
                         before.covariance / before.covariance.diagonal().maxCoeff(),
                         1e-8));
}

// A noise of the robot's side widens the covariance; estimates spread as reported when the noise is
// really there.
TEST(Calibrate, RobotNoiseIsInTheCovariance) {
  auto rng = SeededByTest();
  const BaseAndTool truth = AnyMounts(rng);
  const auto exact = HexapodObservations(rng, truth, 15);
  Matrix6d robot = Matrix6d::Zero();
  robot.diagonal() << 1e-8, 4e-8, 1e-8, 1e-6, 1e-6, 9e-6;
  const Matrix6d l = robot.llt().matrixL();
  const int draws = 1500;
  double normalised = 0.0;
  for (int i = 0; i < draws; ++i) {
    auto rows = exact;
    for (Observation& o : rows) {
      const Pose3d real = Plus(o.base_from_platform, Vector6d(l * testing::Normal(rng, 6)));
      o.world_from_tool = truth.world_from_base * real * truth.platform_from_tool;
      o.robot_covariance = robot;
    }
    testing::AddNoise(rng, TrackerLikeCovariance(), &rows);
    Observations observations = testing::KnownNoise(rows, TrackerLikeCovariance());
    observations.has_robot_noise = true;
    const Estimate estimate = Calibrate(observations, {}, {});
    const Vector12d d = Difference(estimate.mounts, truth);
    normalised += d.dot(estimate.covariance.ldlt().solve(d)) / draws;
  }
  EXPECT_NEAR(normalised, 12.0, 0.6);
}

TEST(Calibrate, AStatedNoiseThatIsTooSmallIsDoubted) {
  auto rng = SeededByTest();
  auto rows = HexapodObservations(rng, AnyMounts(rng), 30);
  testing::AddNoise(rng, TrackerLikeCovariance(), &rows);
  const Estimate estimate =
      Calibrate(testing::KnownNoise(rows, 0.01 * TrackerLikeCovariance()), {}, {});
  EXPECT_NEAR(estimate.noise_scale, 10.0, 1.0);
  EXPECT_TRUE(MatrixNear(
      estimate.covariance, estimate.covariance_unscaled, 0.0));  // the stated noise stands
  EXPECT_EQ(estimate.warnings.size(), 1u);
}

// Once in a thousand measurements by chance; as soon as it shows, else.
TEST(Calibrate, AStatedNoiseIsDoubtedWhenChanceDoesNotExplainTheResiduals) {
  auto rng = SeededByTest();
  const BaseAndTool truth = AnyMounts(rng);
  const auto doubts = [&](double stated_variance) {
    int count = 0;
    for (int draw = 0; draw < 200; ++draw) {
      auto rows = HexapodObservations(rng, truth, 60);
      testing::AddNoise(rng, TrackerLikeCovariance(), &rows);
      count += static_cast<int>(
          Calibrate(testing::KnownNoise(rows, stated_variance * TrackerLikeCovariance()), {}, {})
              .warnings.size());
    }
    return count;
  };
  EXPECT_LE(doubts(1.0), 2);
  EXPECT_GE(doubts(1.0 / (1.25 * 1.25)), 198);
}

// To rounding, not only until the cost is flat: else the order of rows shows.
TEST(Calibrate, TheGradientIsZeroAtTheSolution) {
  auto rng = SeededByTest();
  auto rows = HexapodObservations(rng, AnyMounts(rng), 30);
  testing::AddNoise(rng, TrackerLikeCovariance(), &rows);
  const Estimate e = Calibrate(testing::KnownNoise(rows, TrackerLikeCovariance()), {}, {});
  const std::vector<Matrix6d> whiteners(rows.size(), WhitenerOf(TrackerLikeCovariance()));
  const Vector12d in_sigmas =
      StepFrom(rows, whiteners, e.mounts).y.cwiseQuotient(e.covariance.diagonal().cwiseSqrt());
  EXPECT_LT(in_sigmas.cwiseAbs().maxCoeff(), 1e-10);
}

TEST(Calibrate, TheLinearizedIterationStartsAtTheGuessElseAtTheIdentity) {
  auto rng = SeededByTest();
  const BaseAndTool truth = testing::PaperMounts();
  const Observations observations = testing::UnknownNoise(HexapodObservations(rng, truth, 10));
  const CalibrateOptions options = Linearized(LinearizedOptions::Error::kTwist);
  EXPECT_LT(Calibrate(observations, truth, options).iterations[0].rmspe, 1e-12);
  const double at_identity = Calibrate(observations, {}, options).iterations[0].rmspe;
  EXPECT_GT(at_identity, 1e-3);
  CalibrateOptions from_identity = options;
  from_identity.start = Start::kIdentity;
  EXPECT_EQ(Calibrate(observations, truth, from_identity).iterations[0].rmspe, at_identity);
}

TEST(Calibrate, EveryStartReachesTheSameSolution) {
  auto rng = SeededByTest();
  BaseAndTool truth = testing::PaperMounts();
  auto rows = HexapodObservations(rng, truth, 30);
  testing::AddNoise(rng, TrackerLikeCovariance(), &rows);
  const Observations observations = testing::KnownNoise(rows, TrackerLikeCovariance());
  const Estimate reference = Calibrate(observations, {}, {});
  for (const Start start : {Start::kShah, Start::kParkMartin, Start::kIdentity, Start::kInitial}) {
    CalibrateOptions options;
    options.start = start;
    const Estimate estimate = Calibrate(observations, truth, options);
    EXPECT_LT(Difference(estimate.mounts, reference.mounts).cwiseAbs().maxCoeff(), 1e-9);
  }
}

}  // namespace
}  // namespace hexcal
