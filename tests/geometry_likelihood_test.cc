// SPDX-License-Identifier: BSD-3-Clause
#include "discovery/geometry_likelihood.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "model/forward.h"
#include "model/hexapod.h"
#include "model/nominal_hexapod.h"
#include "testing/random.h"

namespace hexcal {
namespace {

constexpr int kPoses = 12;

// A small hexapod, some poses and their errors: base and tool as nuisances, one level of noise.
struct Scene {
  HexapodGeometry hexapod;
  LinearProblem problem;
  ReportedGap gap;
  GapNoise noise;
};

Scene MakeScene() {
  auto rng = testing::SeededByTest();
  Scene scene;
  NominalHexapod nominal;
  nominal.base_radius = 0.4, nominal.platform_radius = 0.3, nominal.base_height = -0.5;
  scene.hexapod = MakeHexapod(nominal);
  LinearProblem& problem = scene.problem;
  problem.poses = kPoses;
  problem.components.resize(1);
  scene.gap.platform_from_tool = testing::SmallPose(rng, 0.1, 0.5);
  problem.nuisance.resize(6 * kPoses, 12);
  for (int k = 0; k < kPoses; ++k) {
    const Pose3d pose = testing::SmallPose(rng, 0.1, 0.2);
    scene.gap.base_from_platform.push_back(pose);
    problem.nuisance.middleRows<6>(6 * k) << InverseAdjoint(pose * scene.gap.platform_from_tool),
        Matrix6d::Identity();
    Matrix6d component = Matrix6d::Identity();
    component.topLeftCorner<3, 3>() *= 4.0;
    problem.components[0].push_back(component);
  }
  problem.error = 1e-4 * testing::Normal(rng, 6 * kPoses);
  problem.shape_error.resize(0);
  problem.shape_nuisance.resize(0, 12);
  scene.noise.factor = {1e-8};
  scene.noise.weight = Eigen::VectorXd::Ones(kPoses);
  return scene;
}

TEST(GeometryColumns, AreTheDerivativesOfTheExactModel) {
  Scene scene = MakeScene();
  scene.gap.problem = &scene.problem;
  const Eigen::MatrixXd columns = GeometryColumns(scene.gap, scene.hexapod);
  ASSERT_EQ(columns.cols(), kGeometryErrors);
  const LegLengths home = InverseKinematics(scene.hexapod, scene.gap.home);
  const double step = 1e-5;
  for (int k = 0; k < kPoses; ++k) {
    Visit visit;
    visit.base_from_platform = scene.gap.base_from_platform[k];
    const LegLengths travel = InverseKinematics(scene.hexapod, visit.base_from_platform) - home;
    for (int n = 0; n < kGeometryErrors; ++n) {
      const auto at = [&](double error) {
        Corrections<double> corrections;
        if (n < 6) corrections.leg[n] = error;
        if (n >= 6 && n < 12) corrections.leg[n - 6] = error / home.mean() * travel[n - 6];
        if (n >= 12 && n < 30) corrections.base_joints((n - 12) % 3, (n - 12) / 3) = error;
        if (n >= 30) corrections.platform_joints((n - 30) % 3, (n - 30) / 3) = error;
        return Forward({Pose3d(), scene.gap.platform_from_tool}, &scene.hexapod, visit, corrections)
            .world_from_tool;
      };
      const Pose3d here = at(0.0);
      const Vector6d numeric = (Minus(at(step), here) - Minus(at(-step), here)) / (2.0 * step);
      const Vector6d column = columns.block<6, 1>(6 * k, n);
      for (int row = 0; row < 6; ++row)
        EXPECT_NEAR(column[row], numeric[row], 1e-7 * (1.0 + std::abs(numeric[row])))
            << "pose " << k << " error " << n << " row " << row;
    }
  }
}

// ln of the Gaussian density of the errors, base and tool as good as unknown, all covariances
// written out.
double LogDensity(const Scene& scene, double width) {
  const Eigen::MatrixXd columns = GeometryColumns(scene.gap, scene.hexapod);
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(6 * kPoses, 6 * kPoses);
  for (int k = 0; k < kPoses; ++k)
    covariance.block<6, 6>(6 * k, 6 * k) =
        scene.noise.factor[0] * scene.problem.components[0][k] / scene.noise.weight[k];
  covariance += width * width * columns * columns.transpose();
  // Flat priors: projected onto what base and tool cannot move.
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(scene.problem.nuisance);
  const Eigen::MatrixXd whole = qr.householderQ();
  const Eigen::MatrixXd rest = whole.rightCols(6 * kPoses - 12);
  const Eigen::MatrixXd c = rest.transpose() * covariance * rest;
  const Eigen::VectorXd e = rest.transpose() * scene.problem.error;
  const Eigen::LLT<Eigen::MatrixXd> llt(c);
  return -0.5 * e.dot(llt.solve(e)) - Eigen::MatrixXd(llt.matrixL()).diagonal().array().log().sum();
}

TEST(GeometryLikelihood, IsTheDensityWithTheErrorsIntegratedOut) {
  Scene scene = MakeScene();
  scene.gap.problem = &scene.problem;
  scene.noise.weight[3] = 0.4;
  const GeometryLikelihood likelihood(scene.gap, scene.noise);
  for (const double width : {1e-5, 2e-4, 3e-3})
    EXPECT_NEAR(likelihood.LogGain(scene.hexapod, width),
                LogDensity(scene, width) - LogDensity(scene, 0.0),
                1e-6)
        << width;
}

TEST(GeometryLikelihood, SolvesForWhatWasPutIn) {
  Scene scene = MakeScene();
  scene.gap.problem = &scene.problem;
  auto rng = testing::SeededByTest();
  const Eigen::VectorXd errors = 1e-3 * testing::Normal(rng, kGeometryErrors);
  const Eigen::VectorXd mounts = 1e-3 * testing::Normal(rng, 12);
  const Eigen::MatrixXd columns = GeometryColumns(scene.gap, scene.hexapod);
  scene.problem.error = scene.problem.nuisance * mounts + columns * errors;
  const GeometryLikelihood likelihood(scene.gap, scene.noise);
  const GeometryLikelihood::Fit fit = likelihood.Solve(scene.hexapod, 1.0);
  // Errors and mounts are told apart by their priors alone; what they do is not.
  const Eigen::VectorXd left =
      scene.problem.error - scene.problem.nuisance * fit.nuisances - columns * fit.errors;
  EXPECT_LT(left.norm(), 1e-6 * scene.problem.error.norm());
  EXPECT_LT(fit.chi_square, 1e-4);
  EXPECT_GT(fit.freedom, 12.0);
  EXPECT_LE(fit.freedom, kGeometryErrors);
}

}  // namespace
}  // namespace hexcal
