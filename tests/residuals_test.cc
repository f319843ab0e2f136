// SPDX-License-Identifier: BSD-3-Clause
#include <ceres/manifold_test_utils.h>

#include "residuals/pose_error.h"
#include "residuals/pose_manifold.h"
#include "residuals/pose_residual.h"
#include "residuals/whitener.h"
#include "testing/matchers.h"
#include "testing/random.h"

namespace hexcal {
namespace {

using namespace ceres;  // the manifold macro's matchers
using hexcal::testing::JacobianNear;
using hexcal::testing::MatrixNear;
using hexcal::testing::NumericJacobian;
using hexcal::testing::RandomPose;
using hexcal::testing::SeededByTest;

using RowMajor67 = Eigen::Matrix<double, 6, 7, Eigen::RowMajor>;
using RowMajor76 = Eigen::Matrix<double, 7, 6, Eigen::RowMajor>;

// Symmetric, positive definite, far from diagonal.
template <typename Rng>
Matrix6d RandomCovariance(Rng& rng) {
  Matrix6d a;
  for (int i = 0; i < 6; ++i) a.col(i) = hexcal::testing::Normal(rng, 6);
  return a * a.transpose() + 0.1 * Matrix6d::Identity();
}

TEST(PoseManifold, KeepsTheLawsOfAManifold) {
  auto rng = SeededByTest();
  const PoseManifold manifold;
  for (const double step : {0.0, 1e-6, 1e-3, 1.0}) {
    Eigen::VectorXd x(7), y(7);
    const Pose3d pose = RandomPose(rng, 1.0);
    pose.ToParameters(x.data());
    const Eigen::VectorXd delta = step * hexcal::testing::Normal(rng, 6).normalized();
    manifold.Plus(x.data(), delta.data(), y.data());
    Vector6d back;
    manifold.Minus(y.data(), x.data(), back.data());
    ASSERT_TRUE(y.allFinite() && back.allFinite());
    EXPECT_TRUE(MatrixNear(back, delta, 1e-14));
    EXPECT_THAT_MANIFOLD_INVARIANTS_HOLD(manifold, x, delta, y, 1e-8);
  }
}

TEST(PoseManifold, JacobiansAreFiniteAndInverse) {
  auto rng = SeededByTest();
  const PoseManifold manifold;
  double x[7];
  RandomPose(rng, 1.0).ToParameters(x);
  RowMajor76 plus;
  RowMajor67 minus;
  manifold.PlusJacobian(x, plus.data());
  manifold.MinusJacobian(x, minus.data());
  EXPECT_TRUE(MatrixNear(minus * plus, Matrix6d::Identity(), 1e-14));
}

TEST(PoseManifold, AStepsLengthIsItsAngle) {
  const PoseManifold manifold;
  double x[7], y[7];
  Pose3d().ToParameters(x);
  const Vector6d delta = (Vector6d() << 0, 0, 0, 0.01, 0, 0).finished();
  manifold.Plus(x, delta.data(), y);
  EXPECT_NEAR(Eigen::AngleAxisd(Pose3d::FromParameters(y).rotation).angle(), 0.01, 1e-14);
}

TEST(Whitener, GivesTheMahalanobisNormOfACorrelatedError) {
  auto rng = SeededByTest();
  const Matrix6d covariance = RandomCovariance(rng);
  const Vector6d e = hexcal::testing::Normal(rng, 6);
  EXPECT_NEAR((WhitenerOf(covariance) * e).squaredNorm(), e.dot(covariance.inverse() * e), 1e-10);
}

struct Case {
  BaseAndTool truth;
  Pose3d base_from_platform, world_from_tool;
};

template <typename Rng>
Case RandomCase(Rng& rng) {
  Case c{{RandomPose(rng, 1.0), RandomPose(rng, 0.3)}, RandomPose(rng, 0.5), {}};
  c.world_from_tool = c.truth.world_from_base * c.base_from_platform * c.truth.platform_from_tool;
  return c;
}

TEST(PoseResidual, IsZeroAtTheTruthAndMeasuredMinusPredictedInTheToolFrame) {
  auto rng = SeededByTest();
  const Case c = RandomCase(rng);
  EXPECT_LT(PoseError(c.truth, c.base_from_platform, c.world_from_tool).norm(), 1e-14);
  Vector6d off;
  off << 0.01, -0.02, 0.03, 0.1, 0.2, -0.3;
  const Vector6d error = PoseError(c.truth, c.base_from_platform, Plus(c.world_from_tool, off));
  EXPECT_TRUE(MatrixNear(error, off, 1e-14));
}

// At a perfect fit and away from it: exact against numeric on the manifold, and against Ceres's
// automatic derivative.
TEST(PoseResidual, JacobiansAgree) {
  auto rng = SeededByTest();
  for (const double size : {0.0, 1e-4, 0.1, 2.0}) {
    const Case c = RandomCase(rng);
    const Pose3d measured =
        Plus(c.world_from_tool, Vector6d(size * hexcal::testing::Normal(rng, 6).normalized()));
    const Vector6d error = PoseError(c.truth, c.base_from_platform, measured);
    const Matrix6x12d exact =
        PoseErrorJacobian(error, c.base_from_platform * c.truth.platform_from_tool);
    const Eigen::MatrixXd numeric = NumericJacobian(
        [&](const Eigen::VectorXd& d) {
          const BaseAndTool moved{Plus(c.truth.world_from_base, Vector6d(d.head<6>())),
                                  Plus(c.truth.platform_from_tool, Vector6d(d.tail<6>()))};
          return PoseError(moved, c.base_from_platform, measured);
        },
        12);
    EXPECT_TRUE(JacobianNear(exact, numeric, 1e-8)) << size;

    const Matrix6d whitener = WhitenerOf(RandomCovariance(rng));
    const std::unique_ptr<ceres::CostFunction> cost(
        PoseResidual::Create(c.base_from_platform, measured, whitener));
    double base[7], tool[7];
    c.truth.world_from_base.ToParameters(base);
    c.truth.platform_from_tool.ToParameters(tool);
    const double* blocks[] = {base, tool};
    Vector6d residual;
    RowMajor67 by_base, by_tool;
    double* jacobians[] = {by_base.data(), by_tool.data()};
    ASSERT_TRUE(cost->Evaluate(blocks, residual.data(), jacobians));
    EXPECT_TRUE(MatrixNear(residual, whitener * error, 1e-13));
    const PoseManifold manifold;
    RowMajor76 plus_base, plus_tool;
    manifold.PlusJacobian(base, plus_base.data());
    manifold.PlusJacobian(tool, plus_tool.data());
    Matrix6x12d automatic;
    automatic << by_base * plus_base, by_tool * plus_tool;
    EXPECT_TRUE(MatrixNear(automatic, whitener * exact, 1e-11)) << size;
  }
}

}  // namespace
}  // namespace hexcal
