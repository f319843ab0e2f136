// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/pose_fit.h"

#include <ceres/problem.h>
#include <ceres/solver.h>
#include <gtest/gtest.h>

#include "estimator/calibrate.h"
#include "residuals/pose_manifold.h"
#include "residuals/pose_residual.h"
#include "residuals/whitener.h"
#include "testing/matchers.h"
#include "testing/scenes.h"

namespace hexcal {
namespace {

using testing::SeededByTest;

constexpr double kAgreement = 1e-10;  // m, rad; relative for covariances

PoseBatch Packed(const std::vector<Observation>& rows) {
  PoseBatch batch;
  for (const Observation& o : rows) batch.Add(o.base_from_platform, o.world_from_tool);
  return batch;
}

struct Scene {
  BaseAndTool truth;
  std::vector<Observation> rows;
};

Scene NoisyScene(int poses) {
  auto rng = SeededByTest();
  Scene scene{testing::AnyMounts(rng), {}};
  scene.rows = testing::HexapodObservations(rng, scene.truth, poses);
  testing::AddNoise(rng, testing::TrackerLikeCovariance(), &scene.rows);
  return scene;
}

// In units of each pair's standard deviations.
double CovarianceDifference(const Matrix12d& a, const Matrix12d& b) {
  const Vector12d scale = b.diagonal().cwiseSqrt().cwiseInverse();
  const Matrix12d difference = scale.asDiagonal() * (a - b) * scale.asDiagonal();
  return difference.allFinite() ? difference.cwiseAbs().maxCoeff() : 1e300;
}

void ExpectSameEstimate(const Estimate& a, const Estimate& b) {
  EXPECT_TRUE(a.converged && b.converged);
  EXPECT_TRUE(
      testing::MatrixNear(testing::Difference(a.mounts, b.mounts), Vector12d::Zero(), kAgreement));
  EXPECT_LT(CovarianceDifference(a.covariance, b.covariance), kAgreement);
  EXPECT_NEAR(a.chi_square, b.chi_square, kAgreement * b.chi_square);
  EXPECT_NEAR(a.noise.position, b.noise.position, kAgreement * b.noise.position);
  EXPECT_NEAR(a.noise.orientation, b.noise.orientation, kAgreement * b.noise.orientation);
}

Estimate CalibrateBy(Evaluation evaluation, const Observations& observations) {
  CalibrateOptions options;
  options.evaluation = evaluation;
  return Calibrate(observations, {}, options);
}

TEST(PoseFit, AgreesWithOneResidualBlockAPose) {
  auto rng = SeededByTest();
  const Scene scene = NoisyScene(60);
  Observations own_weights = testing::KnownNoise(scene.rows, testing::TrackerLikeCovariance());
  for (Observation& o : own_weights.items) o.tool_covariance *= testing::Uniform(rng, 0.5, 2.0);
  Observations robot = own_weights;
  robot.has_robot_noise = true;
  for (Observation& o : robot.items) o.robot_covariance = 0.3 * testing::TrackerLikeCovariance();
  Observations robot_alone = testing::UnknownNoise(scene.rows);
  robot_alone.has_robot_noise = true;
  for (Observation& o : robot_alone.items)
    o.robot_covariance = 0.3 * testing::TrackerLikeCovariance();
  for (const Observations& observations :
       {testing::UnknownNoise(scene.rows),
        testing::KnownNoise(scene.rows, testing::TrackerLikeCovariance()),
        own_weights,
        robot,
        robot_alone})
    ExpectSameEstimate(CalibrateBy(Evaluation::kStreamed, observations),
                       CalibrateBy(Evaluation::kPerPose, observations));
}

// So many that a sample is fitted first.
TEST(PoseFit, AgreesWithOneResidualBlockAPoseForManyPoses) {
  const Scene scene = NoisyScene(kSampleFrom + 7);
  const Observations observations = testing::UnknownNoise(scene.rows);
  ExpectSameEstimate(CalibrateBy(Evaluation::kStreamed, observations),
                     CalibrateBy(Evaluation::kPerPose, observations));
}

TEST(PoseFit, TheTinySolverFindsTheSame) {
  const Scene scene = NoisyScene(60);
  const PoseBatch batch = Packed(scene.rows);
  const PoseWeights common = PoseWeights::Common(testing::TrackerLikeCovariance());
  PoseFitOptions tiny;
  tiny.method = PoseFitOptions::Method::kTiny;
  for (const PoseWeights* weights : {&common, static_cast<const PoseWeights*>(nullptr)}) {
    const PoseFit a = FitPoses(batch, weights, {}, tiny), b = FitPoses(batch, weights, {}, {});
    ASSERT_TRUE(a.solution.converged && b.solution.converged);
    EXPECT_TRUE(testing::MatrixNear(
        testing::Difference(a.solution.mounts, b.solution.mounts), Vector12d::Zero(), 1e-12));
    EXPECT_LT(CovarianceDifference(CovarianceOf(a), CovarianceOf(b)), kAgreement);
  }
}

TEST(PoseFit, TheTinySolverComesFromAfar) {
  const Scene scene = NoisyScene(30);
  const PoseBatch batch = Packed(scene.rows);
  const PoseWeights weights = PoseWeights::Isotropic(1e-4, 1e-4);
  Vector6d away;
  away << 0.1, -0.2, 0.1, 0.5, -0.4, 0.6;
  const BaseAndTool start = {Plus(scene.truth.world_from_base, away),
                             Plus(scene.truth.platform_from_tool, Vector6d(-away))};
  PoseFitOptions tiny;
  tiny.method = PoseFitOptions::Method::kTiny;
  const PoseFit a = FitPoses(batch, &weights, start, tiny), b = FitPoses(batch, &weights, {}, {});
  ASSERT_TRUE(a.solution.converged) << a.solution.message;
  EXPECT_TRUE(testing::MatrixNear(
      testing::Difference(a.solution.mounts, b.solution.mounts), Vector12d::Zero(), 1e-12));
}

// The loss inside the pass is Ceres's own around every block.
TEST(PoseFit, RobustLossesAgreeWithCeresOwn) {
  Scene scene = NoisyScene(40);
  for (int i = 0; i < 8; ++i)
    scene.rows[5 * i].world_from_tool.translation += Eigen::Vector3d(0.01, -0.005, 0.002 * i);
  const PoseBatch batch = Packed(scene.rows);
  const PoseWeights weights = PoseWeights::Common(testing::TrackerLikeCovariance());
  for (const LossKind kind : {LossKind::kHuber, LossKind::kCauchy, LossKind::kTukey}) {
    PoseFitOptions options;
    options.loss = DefaultLoss(kind);
    const PoseFit fit = FitPoses(batch, &weights, scene.truth, options);
    ASSERT_TRUE(fit.solution.converged) << fit.solution.message;

    ceres::Problem problem;
    double base[7], tool[7];
    scene.truth.world_from_base.ToParameters(base);
    scene.truth.platform_from_tool.ToParameters(tool);
    problem.AddParameterBlock(base, 7, new PoseManifold);
    problem.AddParameterBlock(tool, 7, new PoseManifold);
    const Matrix6d whitener = WhitenerOf(testing::TrackerLikeCovariance());
    for (const Observation& o : scene.rows)
      problem.AddResidualBlock(
          PoseResidual::Create(o.base_from_platform, o.world_from_tool, whitener),
          CeresLoss(options.loss).release(),
          base,
          tool);
    ceres::Solver::Options solver;
    solver.max_num_iterations = 500;
    solver.function_tolerance = solver.parameter_tolerance = 1e-16;
    solver.gradient_tolerance = 1e-12;
    ceres::Solver::Summary summary;
    ceres::Solve(solver, &problem, &summary);
    EXPECT_NEAR(0.5 * fit.equations.squared_norm, summary.final_cost, 1e-10 * summary.final_cost);
    const Vector12d d = testing::Difference(
        fit.solution.mounts, {Pose3d::FromParameters(base), Pose3d::FromParameters(tool)});
    EXPECT_TRUE(testing::MatrixNear(d, Vector12d::Zero(), 1e-8));
  }
}

TEST(PoseFit, ThreadsDoNotChangeABit) {
  const Scene scene = NoisyScene(30000);
  const Observations observations = testing::UnknownNoise(scene.rows);
  CalibrateOptions one, many;
  many.threads = 4;
  const Estimate a = Calibrate(observations, {}, one), b = Calibrate(observations, {}, many);
  EXPECT_TRUE(a.covariance == b.covariance);
  EXPECT_TRUE(a.mounts.world_from_base.Matrix() == b.mounts.world_from_base.Matrix());
  EXPECT_TRUE(a.mounts.platform_from_tool.Matrix() == b.mounts.platform_from_tool.Matrix());
}

}  // namespace
}  // namespace hexcal
