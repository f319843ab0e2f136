// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/chordal_optimum.h"

#include <algorithm>

#include "estimator/closed_form.h"
#include "estimator/nonlinear.h"
#include "testing/matchers.h"
#include "testing/scenes.h"

namespace hexcal {
namespace {

using testing::AnyMounts;
using testing::Difference;
using testing::HexapodObservations;
using testing::Isotropic;
using testing::SeededByTest;

// What is left over in the paper's Table V, a coordinate.
constexpr double kPosition = 7.08e-5 / 1.732;     // m
constexpr double kOrientation = 5.83e-4 / 1.732;  // rad

template <typename Rng>
std::vector<Observation> ArmObservations(Rng& rng, const BaseAndTool& truth, int poses) {
  auto rows = HexapodObservations(rng, truth, poses);
  for (Observation& o : rows) {
    o.base_from_platform = testing::RandomPose(rng, 1.0);
    o.world_from_tool = truth.world_from_base * o.base_from_platform * truth.platform_from_tool;
  }
  return rows;
}

ChordalCost CostOf(const std::vector<Observation>& rows, double position, double orientation) {
  ChordalCost cost;
  for (const Observation& o : rows)
    cost.Add(o, 1.0 / (position * position), 1.0 / (orientation * orientation));
  return cost;
}

ChordalCost PaperCost(const std::vector<Observation>& rows) {
  return CostOf(rows, kPosition, kOrientation);
}

TEST(ChordalCost, IsTheSumOfSquaredMisfitsOfEquationOne) {
  auto rng = SeededByTest();
  const auto rows = ArmObservations(rng, AnyMounts(rng), 7);
  ChordalCost cost;
  double expected = 0.0;
  // Any numbers, not just rotations.
  const Eigen::VectorXd entries = testing::Normal(rng, 18);
  const Eigen::Matrix3d z = Eigen::Map<const Eigen::Matrix3d>(entries.data());
  const Eigen::Matrix3d r = Eigen::Map<const Eigen::Matrix3d>(entries.data() + 9);
  const Eigen::Vector3d t = testing::Normal(rng, 3), c = testing::Normal(rng, 3);
  for (const Observation& o : rows) {
    const double position = testing::Uniform(rng, 1, 9), orientation = testing::Uniform(rng, 1, 9);
    cost.Add(o, position, orientation);
    const Eigen::Matrix3d a = o.base_from_platform.rotation.toRotationMatrix();
    const Eigen::Matrix3d q = o.world_from_tool.rotation.toRotationMatrix();
    const Eigen::Vector3d b =
        c + z * rows[0].world_from_tool.translation - rows[0].base_from_platform.translation;
    const Eigen::Vector3d misfit =
        z * o.world_from_tool.translation - b - o.base_from_platform.translation - a * t;
    expected += 0.5 * orientation * (a * r - z * q).squaredNorm() + position * misfit.squaredNorm();
    EXPECT_TRUE(testing::MatrixNear(cost.BaseShift(z, c), b, 1e-12));
  }
  Eigen::VectorXd v(ChordalCost::kSize);
  v << entries, t, c, 1.0;
  EXPECT_NEAR(v.dot(cost.Form() * v), expected, 1e-11 * expected);
}

TEST(ChordalOptimum, ComesBackToExactBaseAndTool) {
  auto rng = SeededByTest();
  for (int i = 0; i < 100; ++i) {
    const BaseAndTool truth = AnyMounts(rng);
    const auto rows = i % 2 ? ArmObservations(rng, truth, 10) : HexapodObservations(rng, truth, 10);
    const BaseAndTool start{
        Plus(truth.world_from_base, Vector6d(0.1 * testing::Normal(rng, 6))),
        Plus(truth.platform_from_tool, Vector6d(0.1 * testing::Normal(rng, 6)))};
    const ChordalOptimum found = FindChordalOptimum(PaperCost(rows), start);
    EXPECT_LT(Difference(found.mounts, truth).norm(), 1e-10);
    EXPECT_TRUE(found.is_best && found.is_unique);
  }
}

// Ceres's problem with the same weights, angles as they are: apart by less than any noise shows.
TEST(ChordalOptimum, AgreesWithTheNonlinearSolution) {
  auto rng = SeededByTest();
  const BaseAndTool truth = AnyMounts(rng);
  auto rows = HexapodObservations(rng, truth, 60);
  testing::AddNoise(rng, Isotropic(kPosition, kOrientation), &rows);
  const ChordalOptimum found = FindChordalOptimum(PaperCost(rows), truth);
  const Matrix6d whitener =
      Isotropic(kPosition, kOrientation).diagonal().cwiseSqrt().cwiseInverse().asDiagonal();
  const Solution solution =
      SolveNonlinear(rows, std::vector<Matrix6d>(rows.size(), whitener), truth, {});
  ASSERT_TRUE(solution.converged);
  EXPECT_LT(Difference(found.mounts, solution.mounts).norm(), 1e-9);  // deviations are above 1e-5
  EXPECT_NEAR(found.cost, 2.0 * solution.iterations.back().cost, 1e-6 * found.cost);
}

TEST(ChordalOptimum, IsProvenBestAtAnyRotationWithTheNoiseOfThePaper) {
  auto rng = SeededByTest();
  for (int i = 0; i < 400; ++i) {
    const BaseAndTool truth = AnyMounts(rng);
    auto rows = i % 2 ? ArmObservations(rng, truth, 60) : HexapodObservations(rng, truth, 60);
    testing::AddNoise(rng, Isotropic(kPosition, kOrientation), &rows);
    const ChordalOptimum found =
        FindChordalOptimum(PaperCost(rows), SolveClosedForm(ClosedForm::kShah, rows));
    EXPECT_TRUE(found.is_stationary && found.is_best && found.is_unique);
    EXPECT_LT(std::abs(found.gap), 1e-6);
    EXPECT_GT(found.smallest_eigenvalue, 1e-3);
    EXPECT_NEAR(found.cost, 348.0, 150.0);  // chi-square of 360 - 12
  }
}

// From starts all around the descent ends in worse minima, too. Each is one (a small push comes
// back to it), none is certified, and what the dual says of each is true of the best.
TEST(ChordalOptimum, NoWorseMinimumIsProven) {
  auto rng = SeededByTest();
  int worse = 0;
  for (int i = 0; i < 100; ++i) {
    const BaseAndTool truth = AnyMounts(rng);
    auto rows = i % 2 ? ArmObservations(rng, truth, 20) : HexapodObservations(rng, truth, 20);
    testing::AddNoise(rng, Isotropic(0.01, 0.1), &rows);
    const ChordalCost cost = CostOf(rows, 0.01, 0.1);
    const ChordalOptimum best = FindChordalOptimum(cost, truth);
    EXPECT_TRUE(best.is_best);
    for (int k = 0; k < 10; ++k) {
      const ChordalOptimum other = FindChordalOptimum(cost, AnyMounts(rng));
      EXPECT_GE(other.cost, best.cost * (1.0 - 1e-9));
      EXPECT_LE(other.lower_bound, best.cost * (1.0 + 1e-9));
      if (other.cost < best.cost * (1.0 + 1e-6)) continue;
      const Vector6d push = 1e-3 * testing::Normal(rng, 6);
      const ChordalOptimum again = FindChordalOptimum(
          cost, {Plus(other.mounts.world_from_base, push), other.mounts.platform_from_tool});
      if (std::abs(again.cost - other.cost) > 1e-9 * other.cost) continue;  // a saddle
      ++worse;
      EXPECT_TRUE(other.is_stationary);
      EXPECT_FALSE(other.is_best);
      EXPECT_LT(other.smallest_eigenvalue, 0.0);
      EXPECT_GT(other.gap, 0.1);
    }
  }
  EXPECT_GT(worse, 50);
}

// Where the poses say nothing the proof may fail, but what it says stays true.
TEST(ChordalOptimum, TheBoundHoldsForDataWithoutSense) {
  auto rng = SeededByTest();
  for (int i = 0; i < 20; ++i) {
    auto rows = ArmObservations(rng, AnyMounts(rng), 6);
    for (Observation& o : rows) o.world_from_tool = testing::RandomPose(rng, 1.0);
    const ChordalCost cost = CostOf(rows, 1.0, 1.0);
    double smallest = std::numeric_limits<double>::infinity(), bound = -smallest;
    bool proven = false;
    for (int k = 0; k < 50; ++k) {
      const ChordalOptimum found = FindChordalOptimum(cost, AnyMounts(rng));
      smallest = std::min(smallest, found.cost);
      bound = std::max(bound, found.lower_bound);
      if (found.is_best) {
        EXPECT_LE(found.cost, smallest * (1 + 1e-6));
        proven = true;
      }
    }
    EXPECT_LE(bound, smallest * (1 + 1e-9));
    EXPECT_TRUE(!proven || bound >= smallest * (1 - 1e-5));
  }
}

TEST(ChordalOptimum, IsNotUniqueForTurnsAboutOneAxisOrNone) {
  auto rng = SeededByTest();
  for (const double turn : {0.0, 1.0}) {
    const BaseAndTool truth = AnyMounts(rng);
    auto rows = HexapodObservations(rng, truth, 20);
    for (Observation& o : rows) {
      o.base_from_platform.rotation =
          Exp(Eigen::Vector3d(0, 0, turn * testing::Uniform(rng, -1, 1)));
      o.world_from_tool = truth.world_from_base * o.base_from_platform * truth.platform_from_tool;
    }
    const ChordalOptimum found = FindChordalOptimum(PaperCost(rows), truth);
    EXPECT_FALSE(found.is_unique);
    EXPECT_TRUE(found.is_best);  // nothing fits better than what fits exactly
    for (const Observation& o : rows)
      EXPECT_LT(PoseError(found.mounts, o.base_from_platform, o.world_from_tool).norm(), 1e-9);
  }
}

}  // namespace
}  // namespace hexcal
