// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "estimator/streamed_solver.h"
#include "residuals/pose_manifold.h"
#include "residuals/streamed_cost.h"
#include "testing/matchers.h"
#include "testing/scenes.h"

namespace hexcal {
namespace {

using testing::SeededByTest;

// Pose errors in units of 1 mm and 1 mrad as a streamed residual with a block of its own: an offset
// common to all positions, measured too.
class OffsetResidual final : public StreamedResidual {
 public:
  explicit OffsetResidual(std::vector<Observation> rows) : rows_(std::move(rows)) {}

  std::vector<int> BlockSizes() const override { return {7, 7, 3}; }

  // Errors and their derivative, 6n + 3 rows.
  void Rows(double const* const* p, Eigen::VectorXd* r, Eigen::MatrixXd* j) const {
    const BaseAndTool mounts{Pose3d::FromParameters(p[0]), Pose3d::FromParameters(p[1])};
    const Eigen::Map<const Eigen::Vector3d> offset(p[2]);
    const auto n = static_cast<Eigen::Index>(rows_.size());
    r->setZero(6 * n + 3);
    j->setZero(6 * n + 3, 15);
    for (Eigen::Index i = 0; i < n; ++i) {
      const LinearisedError e = Linearise(rows_[i], mounts);
      r->segment<6>(6 * i) = 1e3 * e.error;
      r->segment<3>(6 * i) += 1e3 * offset;
      j->block<6, 12>(6 * i, 0) = 1e3 * e.jacobian;
      j->block<3, 3>(6 * i, 12) = 1e3 * Eigen::Matrix3d::Identity();
    }
    r->tail<3>() = 1e3 * (offset - Eigen::Vector3d(0.003, 0, -0.001));
    j->bottomRightCorner<3, 3>() = 1e3 * Eigen::Matrix3d::Identity();
  }

  NormalEquations Evaluate(double const* const* p) const override {
    Eigen::VectorXd r;
    Eigen::MatrixXd j;
    Rows(p, &r, &j);
    return {j.transpose() * j, j.transpose() * r, r.squaredNorm(), 0.0, 0.0, 1};
  }

 private:
  std::vector<Observation> rows_;
};

struct Scene {
  BaseAndTool truth;
  OffsetResidual residual;
  ParameterBlocks start;
};

Scene MakeScene(int poses) {
  auto rng = SeededByTest();
  const BaseAndTool truth = testing::AnyMounts(rng);
  auto rows = testing::HexapodObservations(rng, truth, poses);
  testing::AddNoise(rng, testing::TrackerLikeCovariance(), &rows);
  ParameterBlocks start =
      BlocksOf({Plus(truth.world_from_base, Vector6d(0.1 * Vector6d::Ones())),
                Plus(truth.platform_from_tool, Vector6d(-0.1 * Vector6d::Ones()))});
  start.emplace_back(Eigen::Vector3d(0.1, 0.2, 0.3));
  return {truth, OffsetResidual(std::move(rows)), std::move(start)};
}

std::vector<const double*> Pointers(const ParameterBlocks& blocks) {
  std::vector<const double*> pointers;
  for (const Eigen::VectorXd& b : blocks) pointers.push_back(b.data());
  return pointers;
}

TEST(WhitenedRows, HaveTheSumsOfAllRows) {
  const Scene scene = MakeScene(4);
  const NormalEquations equations = Evaluate(scene.residual, scene.start);
  const WhitenedRows rows = RowsOf(equations);
  const double size = equations.normal.norm();
  EXPECT_TRUE(testing::MatrixNear(
      rows.jacobian.transpose() * rows.jacobian, equations.normal, 1e-14 * size));
  EXPECT_TRUE(testing::MatrixNear(rows.jacobian.transpose() * rows.residual,
                                  equations.gradient,
                                  1e-13 * equations.gradient.norm()));
  EXPECT_NEAR(rows.residual.squaredNorm(), equations.squared_norm, 1e-12 * equations.squared_norm);
}

// A direction that no row moves leaves rows of zeros and no NaN.
TEST(WhitenedRows, LeaveALostDirectionAlone) {
  Eigen::MatrixXd j(2, 3);
  j << 1, 2, 0, 3, 4, 0;
  const Eigen::Vector2d r(1, -2);
  const WhitenedRows rows = RowsOf({j.transpose() * j, j.transpose() * r, r.squaredNorm()});
  EXPECT_TRUE(
      testing::MatrixNear(rows.jacobian.transpose() * rows.jacobian, j.transpose() * j, 1e-13));
  EXPECT_TRUE(
      testing::MatrixNear(rows.jacobian.transpose() * rows.residual, j.transpose() * r, 1e-13));
  EXPECT_NEAR(rows.residual.squaredNorm(), 5.0, 1e-13);
}

// Ceres is given derivatives by the parameters themselves; along the manifold they are the numeric
// ones of half the squared norm.
TEST(StreamedCost, GradientOnTheManifoldIsTheNumericOne) {
  const Scene scene = MakeScene(4);
  const StreamedCost cost(scene.residual);
  ASSERT_EQ(cost.num_residuals(), 16);
  Eigen::VectorXd r(16);
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  RowMajor jb(16, 7), jt(16, 7), jo(16, 3);
  double* jacobians[] = {jb.data(), jt.data(), jo.data()};
  ASSERT_TRUE(cost.Evaluate(Pointers(scene.start).data(), r.data(), jacobians));
  RowMajor plus_b(7, 6), plus_t(7, 6);
  PoseManifold().PlusJacobian(scene.start[0].data(), plus_b.data());
  PoseManifold().PlusJacobian(scene.start[1].data(), plus_t.data());
  Eigen::VectorXd gradient(15);
  gradient << (jb * plus_b).transpose() * r, (jt * plus_t).transpose() * r, jo.transpose() * r;
  const auto half_norm = [&](const Eigen::VectorXd& d) {
    return Eigen::VectorXd(Eigen::VectorXd::Constant(
        1, 0.5 * Evaluate(scene.residual, Moved(scene.start, d)).squared_norm));
  };
  const Eigen::MatrixXd numeric = testing::NumericJacobian(half_norm, 15);
  EXPECT_TRUE(testing::JacobianNear(gradient.transpose(), numeric, 1e-6));
}

TEST(StreamedCost, CostAloneIsTheSame) {
  const Scene scene = MakeScene(4);
  const StreamedCost cost(scene.residual);
  Eigen::VectorXd alone(16);
  ASSERT_TRUE(cost.Evaluate(Pointers(scene.start).data(), alone.data(), nullptr));
  const double expected = Evaluate(scene.residual, scene.start).squared_norm;
  EXPECT_NEAR(alone.squaredNorm(), expected, 1e-12 * expected);
}

TEST(SolveStreamed, EndsWhereTheGradientIsZeroToRounding) {
  const Scene scene = MakeScene(30);
  ParameterBlocks blocks = scene.start;
  NormalEquations equations;
  const Solution solution = SolveStreamed(scene.residual, {}, &blocks, &equations);
  ASSERT_TRUE(solution.converged) << solution.message;
  equations = Evaluate(scene.residual, blocks);
  const Eigen::VectorXd step = equations.normal.ldlt().solve(equations.gradient);
  EXPECT_LT(std::sqrt(step.dot(equations.normal * step)), 1e-9);
  EXPECT_TRUE(
      testing::PoseNear(solution.mounts.world_from_base, scene.truth.world_from_base, 5e-3, 5e-3));
  EXPECT_NEAR(blocks[2][0], 0.003, 5e-3);
  EXPECT_GT(solution.iterations.front().cost, 10 * solution.iterations.back().cost);
}

TEST(SolveStreamed, SaysThatTheStartIsBeyondNumbers) {
  const Scene scene = MakeScene(4);
  ParameterBlocks blocks = scene.start;
  NormalEquations equations;
  blocks[0][0] = 1e200;
  const Solution solution = SolveStreamed(scene.residual, {}, &blocks, &equations);
  EXPECT_FALSE(solution.converged);
  EXPECT_NE(solution.message.find("range of numbers"), std::string::npos) << solution.message;
}

TEST(SolveStreamed, TooFewIterationsAreNoConvergence) {
  const Scene scene = MakeScene(10);
  ParameterBlocks blocks = scene.start;
  NormalEquations equations;
  NonlinearOptions options;
  options.max_iterations = 1;
  const Solution solution = SolveStreamed(scene.residual, options, &blocks, &equations);
  EXPECT_FALSE(solution.converged);
  EXPECT_FALSE(solution.message.empty());
}

}  // namespace
}  // namespace hexcal
