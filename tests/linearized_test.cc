// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/linearized.h"

#include <array>

#include "geometry/rotation_angles.h"
#include "testing/matchers.h"
#include "testing/scenes.h"

namespace hexcal {
namespace {

using testing::Difference;
using testing::MatrixNear;
using testing::PaperMounts;
using testing::PaperObservations;

LinearizedOptions PaperOptions(int iterations) {
  LinearizedOptions options;
  options.error = LinearizedOptions::Error::kPaper;
  options.max_iterations = iterations;
  return options;
}

// Largest difference of any entry of a 4x4 matrix from a printed table.
double FromTable(const Pose3d& pose, const double (&table)[3][4]) {
  double largest = 0.0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 4; ++j)
      largest = std::max(largest, std::abs(pose.Matrix()(i, j) - table[i][j]));
  return largest;
}

// Table IV, whose digits are cut off, not rounded.
TEST(Linearized, TableIVComesOutAfterFiveIterations) {
  const double base[3][4] = {{0.99993, -0.00499, 0.00999, 0.00799},
                             {0.00519, 0.99978, -0.01999, 0.00100},
                             {-0.00989, 0.02004, 0.99975, -0.00399}};
  const double tool[3][4] = {{0.99919, -0.00099, 0.03998, 0.00700},
                             {0.00219, 0.99954, -0.02997, 0.00199},
                             {-0.03994, 0.03003, 0.99875, -0.00600}};
  const Solution solution = SolveLinearized(PaperObservations(), {}, {}, PaperOptions(5));
  EXPECT_LT(FromTable(solution.mounts.world_from_base, base), 2.15e-5);
  EXPECT_LT(FromTable(solution.mounts.platform_from_tool, tool), 2.15e-5);
}

// Tables I and II give 0.018194 at the start whatever the algorithm; the paper prints 0.020080.
TEST(Linearized, RmspeFallsAsInTableIII) {
  const Solution solution = SolveLinearized(PaperObservations(), {}, {}, PaperOptions(5));
  const double rmspe[5] = {0.018194, 9.44e-4, 6.81e-4, 1.00e-4, 1.6e-5};
  ASSERT_EQ(solution.iterations.size(), 6u);
  for (int k = 0; k < 5; ++k) EXPECT_NEAR(solution.iterations[k].rmspe / rmspe[k], 1.0, 0.02) << k;
  EXPECT_NEAR(solution.iterations[0].rmspe, 0.018194, 5e-7);
  EXPECT_NEAR(solution.iterations[0].rmsoe, 0.07097, 5e-6);
}

// "Made unit magnitude" can be read in several ways; the default is the one nearest to the RMSOE
// that the paper prints.
TEST(Linearized, TheDefaultReadingOfUnitMagnitudeIsTheNearestToTableIII) {
  using Reading = LinearizedOptions::UnitMagnitude;
  const std::array<double, 3> printed = {0.002122, 0.000126, 0.000001};
  const auto largest_log_ratio = [&](Reading reading) {
    LinearizedOptions options = PaperOptions(3);
    options.unit_magnitude = reading;
    const Solution solution = SolveLinearized(PaperObservations(), {}, {}, options);
    double largest = 0.0;
    for (int k = 0; k < 3; ++k)
      largest =
          std::max(largest, std::abs(std::log(solution.iterations[k + 1].rmsoe / printed[k])));
    return largest;
  };
  const double of_default = largest_log_ratio(LinearizedOptions().unit_magnitude);
  EXPECT_NEAR(of_default, 0.923, 0.005);
  for (const Reading other :
       {Reading::kNormalFirst, Reading::kNearestRotation, Reading::kColumns, Reading::kRows})
    EXPECT_GT(largest_log_ratio(other), of_default);
}

TEST(Linearized, ThePapersErrorConvergesToTheTruthInTwenty) {
  const Solution solution = SolveLinearized(PaperObservations(), {}, {}, PaperOptions(20));
  EXPECT_TRUE(solution.converged);
  EXPECT_LT(Difference(solution.mounts, PaperMounts()).norm(), 1e-11);
}

TEST(Linearized, TheTwistErrorIsExactInFour) {
  LinearizedOptions options;
  options.max_iterations = 4;
  const Solution solution = SolveLinearized(PaperObservations(), {}, {}, options);
  EXPECT_LT(Difference(solution.mounts, PaperMounts()).cwiseAbs().maxCoeff(), 1e-10);
  EXPECT_LT(solution.iterations.back().rmspe, 1e-10);
}

TEST(Linearized, TooFewIterationsAreNoConvergence) {
  const Solution solution = SolveLinearized(PaperObservations(), {}, {}, PaperOptions(2));
  EXPECT_FALSE(solution.converged);
  EXPECT_NE(solution.message.find("2 updates"), std::string::npos);
}

// Measured and predicted angles on either side of half a turn are near each other.
TEST(Linearized, AnglesAreComparedAcrossHalfATurn) {
  const Pose3d half_turn{Eigen::Vector3d::Zero(), Exp(Eigen::Vector3d(std::acos(-1.0), 0, 0))};
  std::vector<Observation> rows(3);
  for (int i = 0; i < 3; ++i) {
    rows[i].base_from_platform = {Eigen::Vector3d::UnitX() * i,
                                  Exp(Eigen::Vector3d(0.004 * (i - 1), 0, 0))};
    rows[i].world_from_tool = half_turn * rows[i].base_from_platform;
  }
  Vector6d off = Vector6d::Zero();
  off[3] = 0.01;
  const Solution solution =
      SolveLinearized(rows, {}, {Plus(half_turn, off), Pose3d()}, PaperOptions(1));
  EXPECT_NEAR(solution.iterations[0].rmsoe, 0.01, 1e-12);
}

// The paper's J (Eqs. 15-20) is the derivative of the predicted pose's motion.
TEST(Linearized, ThePapersJacobianIsTheDerivativeOfThePrediction) {
  auto rng = testing::SeededByTest();
  const BaseAndTool mounts = testing::AnyMounts(rng);
  for (const Observation& o : testing::HexapodObservations(rng, mounts, 5)) {
    const Eigen::MatrixXd numeric = testing::NumericJacobian(
        [&](const Eigen::VectorXd& y) {
          const Pose3d moved = Plus(mounts.world_from_base, Vector6d(y.head<6>())) *
                               o.base_from_platform *
                               Plus(mounts.platform_from_tool, Vector6d(y.tail<6>()));
          return Minus(moved, o.world_from_tool);
        },
        12);
    EXPECT_TRUE(testing::JacobianNear(
        PaperJacobian(o.base_from_platform * mounts.platform_from_tool), numeric, 1e-8));
  }
}

TEST(Linearized, ThePapersErrorDerivativeIsThatOfThePoseVector) {
  auto rng = testing::SeededByTest();
  const Pose3d pose = testing::SmallPose(rng, 1.0, 0.8);
  const Eigen::MatrixXd numeric = testing::NumericJacobian(
      [&](const Eigen::VectorXd& d) { return VectorFromPose(Plus(pose, Vector6d(d))); }, 6);
  EXPECT_TRUE(testing::JacobianNear(PaperErrorDerivative(pose), numeric, 1e-8));
}

}  // namespace
}  // namespace hexcal
