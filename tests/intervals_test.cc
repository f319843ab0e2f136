// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/intervals.h"

#include <gtest/gtest.h>

#include <cmath>

#include "estimator/calibrate.h"
#include "estimator/quantiles.h"
#include "testing/matchers.h"
#include "testing/scenes.h"

namespace hexcal {
namespace {

using testing::SeededByTest;

Matrix12d SomeCovariance() {
  auto rng = SeededByTest();
  Matrix12d a;
  for (int i = 0; i < 144; ++i) a(i) = testing::Uniform(rng, -1, 1);
  return a * a.transpose() + Matrix12d::Identity();
}

// A linear model of unit columns and one variance, from its definition.
struct LinearModel {
  VarianceComponent component;
  double variance = 0.0;
  double dof = 0.0;
  Matrix12d covariance;
};

LinearModel MakeModel(int rows) {
  auto rng = SeededByTest();
  Eigen::MatrixXd j(rows, 12);
  for (Eigen::Index i = 0; i < j.size(); ++i) j(i) = testing::Uniform(rng, -1, 1);
  const Eigen::VectorXd e = 0.1 * testing::Normal(rng, rows);
  LinearModel model;
  model.component = {j.transpose() * j, j.transpose() * e, e.squaredNorm(), double(rows)};
  const Matrix12d inverse = model.component.normal.inverse();
  model.dof = rows - 12.0;
  model.variance =
      (e.squaredNorm() - model.component.gradient.dot(inverse * model.component.gradient)) /
      model.dof;
  model.covariance = model.variance * inverse;
  return model;
}

TEST(Variances, OfOneComponentAreTheTextbooks) {
  const LinearModel model = MakeModel(40);
  const Eigen::VectorXd start = Eigen::VectorXd::Ones(1), floor = 1e-20 * start;
  const Variances v = EstimateVariances({model.component}, start, floor);
  EXPECT_NEAR(v.values[0], model.variance, 1e-12 * model.variance);
  const double information = 0.5 * model.dof / (model.variance * model.variance);
  EXPECT_NEAR(v.information(0, 0), information, 1e-9 * information);
}

TEST(Intervals, OfKnownNoiseAreNormalAndChiSquare) {
  const Matrix12d covariance = SomeCovariance();
  const Intervals intervals = IntervalsOfKnownNoise(covariance);
  for (int i = 0; i < 12; ++i)
    EXPECT_NEAR(intervals.half_width[i], 1.959963984540054 * std::sqrt(covariance(i, i)), 1e-5);
  EXPECT_NEAR(intervals.ellipsoid, 21.02606981748307, 1e-9);
  EXPECT_TRUE(std::isinf(intervals.degrees_of_freedom[0]));
}

// With one level of noise Kenward and Roger's approximation is the exact t and F.
TEST(Intervals, OfOneEstimatedLevelAreExactlyStudentAndFisher) {
  const LinearModel model = MakeModel(20);
  const Variances v = EstimateVariances(
      {model.component}, Eigen::VectorXd::Ones(1), Eigen::VectorXd::Constant(1, 1e-20));
  const Intervals intervals = IntervalsOfEstimatedNoise(model.covariance, {model.component}, v);
  for (int i = 0; i < 12; ++i) {
    EXPECT_NEAR(intervals.degrees_of_freedom[i], 8.0, 1e-7);
    EXPECT_NEAR(intervals.half_width[i],
                StudentTQuantile(0.975, 8.0) * std::sqrt(model.covariance(i, i)),
                1e-8 * intervals.half_width[i]);
  }
  EXPECT_NEAR(intervals.ellipsoid, 12.0 * FisherFQuantile(0.95, 12.0, 8.0), 1e-5);
}

// The interval of a mix is that of a parameter in coordinates of which the mix is one.
TEST(Intervals, OfMixesDoNotDependOnTheCoordinates) {
  auto rng = SeededByTest();
  std::vector<VarianceComponent> components;
  for (int k = 0; k < 2; ++k) {
    Eigen::MatrixXd j(15 + 9 * k, 12);
    for (Eigen::Index i = 0; i < j.size(); ++i) j(i) = testing::Uniform(rng, -1, 1);
    const Eigen::VectorXd e = (k + 1.0) * testing::Normal(rng, static_cast<int>(j.rows()));
    components.push_back({j.transpose() * j, j.transpose() * e, e.squaredNorm(), double(j.rows())});
  }
  const Variances v =
      EstimateVariances(components, Eigen::VectorXd::Ones(2), Eigen::VectorXd::Constant(2, 1e-20));
  const Matrix12d covariance =
      (components[0].normal / v.values[0] + components[1].normal / v.values[1]).inverse();
  const Intervals intervals = IntervalsOfEstimatedNoise(covariance, components, v);
  Matrix12d mixes;
  for (int i = 0; i < 144; ++i) mixes(i) = testing::Uniform(rng, -1, 1);
  const Matrix12d back = mixes.inverse();
  for (VarianceComponent& c : components) c.normal = back.transpose() * c.normal * back;
  const Intervals expected =
      IntervalsOfEstimatedNoise(mixes * covariance * mixes.transpose(), components, v);
  for (int i = 0; i < 12; ++i) {
    const NumberInterval mix = IntervalOf(intervals, covariance, mixes.row(i));
    EXPECT_NEAR(mix.half_width, expected.half_width[i], 1e-8 * expected.half_width[i]);
    EXPECT_NEAR(mix.degrees_of_freedom,
                expected.degrees_of_freedom[i],
                1e-6 * expected.degrees_of_freedom[i]);
  }
  EXPECT_GT((expected.degrees_of_freedom - intervals.degrees_of_freedom).norm(), 0.1);
}

// Two levels, few poses: what the reported intervals promise is kept.
TEST(Intervals, CoverWithFewPosesAndEstimatedNoise) {
  auto rng = SeededByTest();
  const BaseAndTool truth = testing::AnyMounts(rng);
  const auto exact = testing::HexapodObservations(rng, truth, 10);
  Vector6d variances;
  variances << Eigen::Vector3d::Constant(1e-8), Eigen::Vector3d::Constant(4e-6);
  const int draws = 2000;
  Vector12d covered = Vector12d::Zero();
  int in_ellipsoid = 0;
  for (int k = 0; k < draws; ++k) {
    auto rows = exact;
    testing::AddNoise(rng, variances.asDiagonal(), &rows);
    const Estimate e = Calibrate(testing::UnknownNoise(rows), {}, {});
    const Vector12d d = testing::Difference(e.mounts, truth);
    for (int i = 0; i < 12; ++i) covered[i] += std::abs(d[i]) <= e.intervals.half_width[i];
    in_ellipsoid += d.dot(e.covariance.ldlt().solve(d)) <= e.intervals.ellipsoid;
    EXPECT_LT(e.intervals.degrees_of_freedom.maxCoeff(), 48.0 + 1e-6);
  }
  // 2,000 draws: a standard deviation of 0.5 %.
  EXPECT_GT(covered.minCoeff() / draws, 0.93);
  EXPECT_LT(covered.maxCoeff() / draws, 0.97);
  EXPECT_NEAR(in_ellipsoid / double(draws), 0.95, 0.02);
}

}  // namespace
}  // namespace hexcal
