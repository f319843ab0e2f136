// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/pivot.h"

#include <ceres/ceres.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "config/units.h"
#include "estimator/pivot_outliers.h"
#include "estimator/quantiles.h"
#include "geometry/linear_algebra.h"
#include "testing/matchers.h"
#include "testing/pivot_scene.h"

namespace hexcal {
namespace {

using ::hexcal::testing::DrawPivotPoses;
using ::hexcal::testing::IsotropicNoise;
using ::hexcal::testing::MatrixNear;
using ::hexcal::testing::NumericJacobian;
using ::hexcal::testing::PivotPoseAt;
using ::hexcal::testing::PivotScene;
using ::hexcal::testing::SeededByTest;
using ::hexcal::testing::UniformVector;
using ::hexcal::testing::WithNoise;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

const Matrix6d kNoise = IsotropicNoise(1e-4, 1e-3);

Eigen::Quaterniond About(const Eigen::Vector3d& axis, double angle) {
  return Exp(Eigen::Vector3d(angle * axis));
}

std::vector<bool> All(const PivotPoses& poses) {
  return std::vector<bool>(poses.items.size(), true);
}

TEST(Pivot, HandWorkedTip) {
  PivotPoses poses;
  poses.noise = PivotNoise::kUnknown;
  const double h = 0.5 * kPi;
  poses.items = {{"1", 0, {{1, 2, -2}, Eigen::Quaterniond::Identity()}},
                 {"2", 0, {{1, 7, 3}, About({1, 0, 0}, h)}},
                 {"3", 0, {{-4, 2, 3}, About({0, 1, 0}, h)}}};
  const PivotResult result = CalibratePivot(poses, {});
  EXPECT_TRUE(MatrixNear(result.x.tip_in_tool, Eigen::Vector3d(0, 0, 5), 1e-12));
  EXPECT_TRUE(MatrixNear(result.x.pivot_in_world, Eigen::Vector3d(1, 2, 3), 1e-12));
  EXPECT_LT(result.rms, 1e-12);
  EXPECT_TRUE(result.IsTrustworthy());
}

// Half turns about the three axes: the rotations add up to zero, tip and pivot are not correlated,
// and each is the mean of four readings.
TEST(Pivot, HandWorkedCovariance) {
  const TipAndPivot truth = {{0, 0, 0}, {1, 2, 3}};
  const double sigma = 0.002;
  PivotPoses poses;
  poses.noise = PivotNoise::kKnown;
  for (const Eigen::Vector3d& turn : {Eigen::Vector3d(0, 0, 0),
                                      Eigen::Vector3d(kPi, 0, 0),
                                      Eigen::Vector3d(0, kPi, 0),
                                      Eigen::Vector3d(0, 0, kPi)})
    poses.items.push_back(PivotPoseAt(Exp(turn), truth, IsotropicNoise(sigma, 1e-3), 0));
  const PivotResult result = CalibratePivot(poses, {});
  EXPECT_TRUE(MatrixNear(result.covariance / (sigma * sigma), 0.25 * Matrix6d::Identity(), 1e-10));
  EXPECT_NEAR(result.half_width[2], 1.959964 * sigma / 2, 1e-8);
  EXPECT_NEAR(result.condition_number, 1.0, 1e-12);
  EXPECT_TRUE(MatrixNear(result.tilts.rms, Eigen::Vector3d::Ones(), 1e-12));
}

TEST(Pivot, RecoversTipAndPivotWithoutNoise) {
  auto rng = SeededByTest();
  for (const double cone : {0.02, 0.5, 2.0})
    for (const PivotNoise noise :
         {PivotNoise::kKnown, PivotNoise::kUpToScale, PivotNoise::kUnknown}) {
      PivotScene pivoting;
      pivoting.cone = cone;
      PivotPoses poses = DrawPivotPoses(pivoting, kNoise, rng);
      poses.noise = noise;
      const PivotResult result = CalibratePivot(poses, {});
      EXPECT_TRUE(result.IsTrustworthy());
      const double tolerance = 1e-13 / (cone * cone);
      EXPECT_TRUE(MatrixNear(result.x.tip_in_tool, pivoting.truth.tip_in_tool, tolerance));
      EXPECT_TRUE(MatrixNear(result.x.pivot_in_world, pivoting.truth.pivot_in_world, tolerance));
    }
}

TEST(Pivot, MovingTheWorldMovesThePivotAlone) {
  auto rng = SeededByTest();
  const PivotPoses poses = WithNoise(DrawPivotPoses({}, kNoise, rng), rng);
  PivotPoses moved = poses;
  const Pose3d other_from_world = testing::RandomPose(rng, 1.0);
  for (PivotPose& pose : moved.items)
    pose.world_from_tool = other_from_world * pose.world_from_tool;
  const PivotResult a = CalibratePivot(poses, {}), b = CalibratePivot(moved, {});
  EXPECT_TRUE(MatrixNear(b.x.tip_in_tool, a.x.tip_in_tool, 1e-12));
  EXPECT_TRUE(MatrixNear(b.x.pivot_in_world, other_from_world * a.x.pivot_in_world, 1e-12));
  EXPECT_TRUE(
      MatrixNear(b.covariance.topLeftCorner<3, 3>(), a.covariance.topLeftCorner<3, 3>(), 1e-18));
}

TEST(Pivot, JacobiansAgreeWithDifferences) {
  auto rng = SeededByTest();
  const PivotScene pivoting;
  const Pose3d pose = testing::RandomPose(rng, 1.0);
  // At the pivot, where the motion of the axes that the error is given in does not show.
  const TipAndPivot x = {pivoting.truth.tip_in_tool, pose * pivoting.truth.tip_in_tool};
  const auto by_pose = [&](const Eigen::VectorXd& d) -> Eigen::VectorXd {
    return PivotError(Plus(pose, Vector6d(d)), x);
  };
  EXPECT_TRUE(MatrixNear(PivotPoseJacobian(x), NumericJacobian(by_pose, 6), 1e-8));
  const auto by_parameters = [&](const Eigen::VectorXd& d) -> Eigen::VectorXd {
    return PivotError(pose, {x.tip_in_tool + d.head<3>(), x.pivot_in_world + d.tail<3>()});
  };
  EXPECT_TRUE(MatrixNear(PivotParameterJacobian(pose), NumericJacobian(by_parameters, 6), 1e-8));
}

// The true pose of a measurement is its rotation alone: the tip is at the pivot. So written, the
// problem is an ordinary one, with three more parameters a pose.
struct FullError {
  const PivotPose& measured;
  template <typename T>
  bool operator()(const T* tip, const T* pivot, const T* turn, T* error) const {
    using Vector3 = Eigen::Matrix<T, 3, 1>;
    const Eigen::Map<const Vector3> p(tip), c(pivot), v(turn);
    const Pose<T> pose = measured.world_from_tool.Cast<T>();
    Pose<T> truth;
    truth.rotation = pose.rotation * Exp(Vector3(v));
    truth.translation = c - truth.rotation * Vector3(p);
    const Eigen::Matrix<T, 6, 1> d = Minus(pose, truth);
    const Matrix6d whitener = measured.covariance.llt().matrixL().solve(Matrix6d::Identity());
    Eigen::Map<Eigen::Matrix<T, 6, 1>>(error, 6, 1) = whitener.cast<T>() * d;
    return true;
  }
};

TEST(Pivot, AgreesWithCeresOnAllPosesAndTipTogether) {
  auto rng = SeededByTest();
  PivotScene pivoting;
  pivoting.poses = 9;
  Matrix6d noise = IsotropicNoise(2e-3, 1e-2);
  noise(0, 0) *= 4.0;
  noise(0, 4) = noise(4, 0) = 1e-5;
  const PivotPoses poses = WithNoise(DrawPivotPoses(pivoting, noise, rng), rng);
  const PivotSolution own = SolvePivot(poses, All(poses), {});

  Eigen::Vector3d tip = own.fit.x.tip_in_tool + Eigen::Vector3d(0.01, 0.02, -0.01);
  Eigen::Vector3d pivot = own.fit.x.pivot_in_world;
  Eigen::Matrix3Xd turns = Eigen::Matrix3Xd::Zero(3, pivoting.poses);
  ceres::Problem problem;
  for (int i = 0; i < pivoting.poses; ++i)
    problem.AddResidualBlock(
        new ceres::AutoDiffCostFunction<FullError, 6, 3, 3, 3>(new FullError{poses.items[i]}),
        nullptr,
        tip.data(),
        pivot.data(),
        turns.col(i).data());
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.function_tolerance = options.parameter_tolerance = options.gradient_tolerance = 1e-15;
  options.max_num_iterations = 200;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  ceres::Covariance covariance({});
  const std::vector<std::pair<const double*, const double*>> blocks = {{tip.data(), tip.data()}};
  ASSERT_TRUE(covariance.Compute(blocks, &problem));
  Eigen::Matrix<double, 3, 3, Eigen::RowMajor> of_tip;
  covariance.GetCovarianceBlock(tip.data(), tip.data(), of_tip.data());

  // Sigmas are millimetres; what is left is the curvature of the poses' motion.
  const Eigen::Vector3d sigma = of_tip.diagonal().cwiseSqrt();
  const Eigen::Vector3d apart = own.fit.x.tip_in_tool - tip;
  EXPECT_LT(apart.cwiseQuotient(sigma).norm(), 0.02);
  EXPECT_NEAR(own.fit.squared_sigmas, 2.0 * summary.final_cost, 0.02);
  const Eigen::Matrix3d scaled = sigma.cwiseInverse().asDiagonal() *
                                 (own.covariance.topLeftCorner<3, 3>() - of_tip) *
                                 sigma.cwiseInverse().asDiagonal();
  EXPECT_LT(scaled.norm(), 0.05);
}

// Where only positions err and all weights are equal, the maximum likelihood is least squares.
TEST(Pivot, IsLeastSquaresWhereOnlyPositionsErr) {
  auto rng = SeededByTest();
  const PivotPoses poses = WithNoise(DrawPivotPoses({}, IsotropicNoise(1e-3, 1e-12), rng), rng);
  const auto n = static_cast<Eigen::Index>(poses.items.size());
  Eigen::MatrixXd a(3 * n, 6);
  Eigen::VectorXd b(3 * n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Pose3d& pose = poses.items[static_cast<std::size_t>(i)].world_from_tool;
    a.middleRows<3>(3 * i) << pose.rotation.toRotationMatrix(), -Eigen::Matrix3d::Identity();
    b.segment<3>(3 * i) = -pose.translation;
  }
  const Eigen::VectorXd x = ShortestSolution(a, b, 1e-12);
  const PivotSolution own = SolvePivot(poses, All(poses), {});
  EXPECT_TRUE(MatrixNear(own.fit.x.tip_in_tool, x.head<3>(), 1e-11));
  EXPECT_TRUE(MatrixNear(own.fit.x.pivot_in_world, x.tail<3>(), 1e-11));
  EXPECT_TRUE(MatrixNear(own.covariance, 1e-6 * (a.transpose() * a).inverse(), 1e-14));
  const SingularValues svd = Decompose(a);
  EXPECT_NEAR(PivotCondition(own.tilts), svd.singular_values[0] / svd.singular_values[5], 1e-9);
}

// The paper's way: the origins of the tool's frame lie on a sphere around the pivot. It uses no
// rotation.
TEST(Pivot, AgreesWithTheSphereThroughTheOrigins) {
  auto rng = SeededByTest();
  PivotScene pivoting;
  pivoting.poses = 200;
  const PivotPoses poses =
      WithNoise(DrawPivotPoses(pivoting, IsotropicNoise(1e-5, 1e-4), rng), rng);
  Eigen::MatrixXd a(pivoting.poses, 4);
  Eigen::VectorXd b(pivoting.poses);
  for (int i = 0; i < pivoting.poses; ++i) {
    const Eigen::Vector3d& t = poses.items[i].world_from_tool.translation;
    a.row(i) << 2.0 * t.transpose(), 1.0;
    b[i] = t.squaredNorm();
  }
  const Eigen::VectorXd x = ShortestSolution(a, b, 1e-14);
  const double radius = std::sqrt(x[3] + x.head<3>().squaredNorm());
  const PivotResult result = CalibratePivot(poses, {});
  EXPECT_TRUE(MatrixNear(result.x.pivot_in_world, x.head<3>(), 5e-5));
  EXPECT_NEAR(result.x.tip_in_tool.norm(), radius, 5e-5);
}

TEST(Pivot, NamesOutliersAndFitsAroundThem) {
  auto rng = SeededByTest();
  const PivotScene pivoting;
  for (const PivotNoise noise : {PivotNoise::kKnown, PivotNoise::kUnknown}) {
    PivotPoses poses = WithNoise(DrawPivotPoses(pivoting, kNoise, rng), rng);
    poses.noise = noise;
    // The tip slipped, together in one direction; and one reading of another body.
    for (const std::size_t i : {3, 4, 5, 6, 11, 19})
      poses.items[i].world_from_tool.translation += Eigen::Vector3d(0.004, 0.001, 0);
    poses.items[25].world_from_tool = testing::RandomPose(rng, 1.0);
    PivotOptions options;
    options.reject_outliers = true;
    const PivotResult result = CalibratePivot(poses, options);
    std::vector<std::size_t> found;
    for (const PivotOutlier& outlier : result.outliers) found.push_back(outlier.index);
    EXPECT_THAT(found, ElementsAre(3, 4, 5, 6, 11, 19, 25));
    EXPECT_NEAR(result.outliers[0].distance, 0.0041, 0.001);
    EXPECT_FALSE(result.rows[3].used);
    const Eigen::Vector3d off = result.x.tip_in_tool - pivoting.truth.tip_in_tool;
    EXPECT_LT(off.dot(result.covariance.topLeftCorner<3, 3>().inverse() * off), 16.0);
    EXPECT_THAT(result.warnings[0], HasSubstr("pose 4 is left out as an outlier"));

    options.reject_outliers = false;
    const PivotResult kept = CalibratePivot(poses, options);
    EXPECT_EQ(kept.outliers.size(), 7u);
    EXPECT_TRUE(kept.rows[3].used);
    EXPECT_THAT(kept.warnings[0], HasSubstr("looks like an outlier, but is used"));
    EXPECT_GT((kept.x.tip_in_tool - pivoting.truth.tip_in_tool).norm(), 2.0 * off.norm());
  }
}

TEST(Pivot, OneCleanSetInAHundredListsAnOutlier) {
  auto rng = SeededByTest();
  const PivotPoses clean = DrawPivotPoses({}, kNoise, rng);
  constexpr int kDraws = 400;
  for (const PivotNoise noise : {PivotNoise::kKnown, PivotNoise::kUnknown}) {
    int alarms = 0;
    for (int k = 0; k < kDraws; ++k) {
      PivotPoses poses = WithNoise(clean, rng);
      poses.noise = noise;
      alarms += !FindPivotOutliers(poses, {}).empty();
    }
    EXPECT_LE(alarms, 13);  // 4 are expected; more than 13 once in 10,000
  }
}

TEST(Pivot, TurnsAboutOneAxisTellTheTipAcrossItOnly) {
  auto rng = SeededByTest();
  const PivotScene pivoting;
  const Eigen::Vector3d axis = Eigen::Vector3d(1, 2, 3).normalized();
  PivotPoses poses;
  for (int i = 0; i < 20; ++i)
    poses.items.push_back(PivotPoseAt(About(axis, 0.1 * i), pivoting.truth, kNoise, i));
  for (const PivotNoise noise : {PivotNoise::kKnown, PivotNoise::kUnknown})
    for (const bool is_noisy : {false, true}) {
      PivotPoses tried = is_noisy ? WithNoise(poses, rng) : poses;
      tried.noise = noise;
      const PivotResult result = CalibratePivot(tried, {});
      EXPECT_FALSE(result.IsTrustworthy());
      ASSERT_EQ(result.lost_count(), 1);
      EXPECT_NEAR(std::abs(result.tilts.directions.col(0).dot(axis)), 1.0, 1e-3);
      EXPECT_THAT(result.warnings.back(), HasSubstr("not determined along"));
      const Eigen::Vector3d n = result.tilts.directions.col(0);
      const Eigen::Vector3d off = result.x.tip_in_tool - pivoting.truth.tip_in_tool;
      EXPECT_LT((off - n * n.dot(off)).norm(), is_noisy ? 2e-3 : 1e-12);
      EXPECT_NEAR(result.x.tip_in_tool.dot(n), 0.0, 1e-12);
      EXPECT_NEAR(n.dot(result.covariance.topLeftCorner<3, 3>() * n), 0.0, 1e-20);
      for (int k = 0; k < 3; ++k) EXPECT_FALSE(result.IsDetermined(k));
    }
}

TEST(Pivot, ALostAxisLeavesTheOtherTwoCoordinates) {
  const PivotScene pivoting;
  PivotPoses poses;
  poses.noise = PivotNoise::kKnown;
  for (int i = 0; i < 8; ++i)
    poses.items.push_back(PivotPoseAt(About({0, 0, 1}, 0.3 * i), pivoting.truth, kNoise, i));
  const PivotResult result = CalibratePivot(poses, {});
  EXPECT_TRUE(result.IsDetermined(0));
  EXPECT_TRUE(result.IsDetermined(1));
  EXPECT_FALSE(result.IsDetermined(2));
  EXPECT_NEAR(result.x.tip_in_tool.x(), pivoting.truth.tip_in_tool.x(), 1e-12);
}

TEST(Pivot, TranslationsTellNothing) {
  auto rng = SeededByTest();
  PivotPoses poses;
  poses.noise = PivotNoise::kKnown;
  for (int i = 0; i < 8; ++i)
    poses.items.push_back({std::to_string(i), 0, {UniformVector(rng, 0.1)}, kNoise});
  const PivotResult result = CalibratePivot(poses, {});
  EXPECT_EQ(result.lost_count(), 3);
  EXPECT_FALSE(result.IsTrustworthy());
  EXPECT_THAT(result.warnings.back(), HasSubstr("do not turn the tool by more than"));
}

TEST(Pivot, ATooSmallConeIsLostAndASmallOneWarnedOf) {
  auto rng = SeededByTest();
  PivotScene pivoting;
  pivoting.cone = 0.003;  // of 0.001 rad noise
  EXPECT_GE(CalibratePivot(WithNoise(DrawPivotPoses(pivoting, kNoise, rng), rng), {}).lost_count(),
            1);
  pivoting.cone = 0.01;
  const PivotResult small =
      CalibratePivot(WithNoise(DrawPivotPoses(pivoting, kNoise, rng), rng), {});
  EXPECT_TRUE(small.IsTrustworthy());
  EXPECT_THAT(small.warnings.back(), HasSubstr("tilt the tool further"));
}

TEST(Pivot, NoiseThatWasUnderstatedIsSaid) {
  auto rng = SeededByTest();
  PivotPoses poses = WithNoise(DrawPivotPoses({}, kNoise, rng), rng);
  for (PivotPose& pose : poses.items) pose.covariance *= 0.25;
  const PivotResult result = CalibratePivot(poses, {});
  EXPECT_GT(result.chi_square, result.chi_square_high);
  EXPECT_THAT(result.warnings.back(), HasSubstr("times what the stated noise explains"));
}

}  // namespace
}  // namespace hexcal
