// SPDX-License-Identifier: BSD-3-Clause
// Designs on random rows against explicit least squares. What rows mean is tested with plan.
#include "discovery/design_model.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <numeric>

#include "discovery/exchange.h"
#include "geometry/linear_algebra.h"
#include "testing/random.h"

namespace hexcal {
namespace {

using ::hexcal::testing::Normal;
using ::hexcal::testing::SeededByTest;

constexpr int kPoses = 40, kRowsAPose = 6, kUnknowns = 5;

DesignRows EqualRows() {
  DesignRows rows;
  for (int pose = 0; pose <= kPoses; ++pose) rows.first.push_back(kRowsAPose * pose);
  return rows;
}

// Unknowns of very different units.
template <typename Rng>
DesignModel AnyModel(Rng& rng) {
  DesignModel model;
  model.columns.resize(kPoses * kRowsAPose, kUnknowns);
  for (int k = 0; k < kUnknowns; ++k)
    model.columns.col(k) = std::pow(10.0, k) * Normal(rng, kPoses * kRowsAPose);
  return model;
}

std::vector<int> Range(int from, int to) {
  std::vector<int> range(to - from);
  std::iota(range.begin(), range.end(), from);
  return range;
}

TEST(DesignModel, DistanceIsWhatLeastSquaresLeaves) {
  auto rng = SeededByTest();
  DesignModel model = AnyModel(rng);
  model.signal = Normal(rng, kPoses * kRowsAPose);
  const DesignRows rows = EqualRows();
  const std::vector<int> poses = {3, 8, 9, 20, 31};
  const Eigen::MatrixXd x = RowsOf(rows, model.columns, poses);
  const Eigen::VectorXd s = RowsOf(rows, model.signal, poses);
  const double left = (s - x * ShortestSolution(x, s, 1e-12)).squaredNorm();
  EXPECT_NEAR(DesignState(model, rows, poses).value(), left, 1e-6 * left);
}

TEST(DesignModel, DeterminantIsThatOfTheInverseCovarianceOfWhatIsAskedFor) {
  auto rng = SeededByTest();
  DesignModel model = AnyModel(rng);
  model.nuisances = 2;
  const DesignRows rows = EqualRows();
  const std::vector<int> all = Range(0, kPoses);
  // Unknowns are scaled by their columns' length, which moves the logarithm by a constant.
  const Eigen::VectorXd length = model.columns.colwise().norm();
  const auto asked = [&](const std::vector<int>& poses) {
    const Eigen::MatrixXd x =
        RowsOf(rows, model.columns, poses) * length.cwiseInverse().asDiagonal();
    const Eigen::MatrixXd covariance = (x.transpose() * x).inverse();
    return -std::log(covariance.bottomRightCorner(3, 3).determinant());
  };
  for (const auto& poses : {all, Range(5, 12)})
    EXPECT_NEAR(DesignState(model, rows, poses).value(), asked(poses), 1e-5);
}

TEST(DesignModel, OneMorePoseIsForetoldExactly) {
  auto rng = SeededByTest();
  const DesignRows rows = EqualRows();
  for (const bool has_signal : {false, true}) {
    DesignModel model = AnyModel(rng);
    model.nuisances = has_signal ? 0 : 2;
    model.prior = Eigen::VectorXd::Constant(kUnknowns, 0.3);
    if (has_signal) model.signal = Normal(rng, kPoses * kRowsAPose);
    const DesignState state(model, rows, {1, 2, 3});
    for (const int pose : {0, 17, 39}) {
      const double value = DesignState(model, rows, {1, 2, 3, pose}).value();
      EXPECT_NEAR(state.With(pose), value, 1e-9 * std::abs(value));
      EXPECT_GT(state.With(pose), state.value());
    }
  }
}

TEST(Exchange, NoSingleExchangeImprovesTheChoiceAndRandomChoicesAreWorse) {
  auto rng = SeededByTest();
  const DesignRows rows = EqualRows();
  DesignGoal goal;
  goal.parameters = AnyModel(rng);
  goal.parameter_weight = 0.1;
  for (int pair = 0; pair < 2; ++pair) {
    goal.pairs.emplace_back();
    for (int form = 0; form < 2; ++form) {
      goal.pairs.back().push_back(AnyModel(rng));
      goal.pairs.back().back().signal = Normal(rng, kPoses * kRowsAPose);
    }
  }
  const std::vector<int> known = {0, 1}, candidates = Range(2, kPoses);
  const std::vector<int> chosen = ChoosePoses(goal, rows, known, candidates, 6, nullptr);
  ASSERT_EQ(chosen.size(), 6u);
  const auto value = [&](std::vector<int> poses) {
    poses.insert(poses.end(), known.begin(), known.end());
    return UtilityOf(goal, rows, poses);
  };
  const double best = value(chosen);
  for (std::size_t i = 0; i < chosen.size(); ++i)
    for (const int pose : candidates) {
      if (std::count(chosen.begin(), chosen.end(), pose) > 0) continue;
      std::vector<int> other = chosen;
      other[i] = pose;
      EXPECT_LE(value(other), best + 1e-8);
    }
  for (int draw = 0; draw < 50; ++draw) {
    std::vector<int> other = candidates;
    std::shuffle(other.begin(), other.end(), rng);
    other.resize(chosen.size());
    EXPECT_LE(value(other), best);
  }
}

TEST(Exchange, APairCountsByItsNearestForm) {
  auto rng = SeededByTest();
  const DesignRows rows = EqualRows();
  DesignGoal goal;
  goal.parameters = AnyModel(rng);
  goal.parameter_weight = 0.0;
  DesignModel near = AnyModel(rng), far = near;
  near.signal = 0.1 * Normal(rng, kPoses * kRowsAPose);
  far.signal = 10.0 * near.signal;
  goal.pairs = {{far, near}};
  const std::vector<int> poses = Range(0, 10);
  EXPECT_NEAR(UtilityOf(goal, rows, poses),
              std::log1p(DesignState(near, rows, poses).value() / kApart),
              1e-12);
}

}  // namespace
}  // namespace hexcal
