// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/error_length.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <numeric>

#include "testing/random.h"

namespace hexcal {
namespace {

constexpr double kKnown = std::numeric_limits<double>::infinity();

Eigen::Matrix3d Turned(const Eigen::Vector3d& variances) {
  const Eigen::Matrix3d r = Eigen::Quaterniond(0.3, -0.7, 0.2, 0.6).normalized().matrix();
  return r * variances.asDiagonal() * r.transpose();
}

// Textbook factors of 95 % on a line, in a plane and in space.
TEST(ErrorLength, IsNormalOnALineAndChiInAPlaneAndInSpace) {
  EXPECT_NEAR(LengthQuantile(Turned({4.0, 0.0, 0.0}), 0.95, kKnown), 2.0 * 1.959964, 1e-5);
  EXPECT_NEAR(LengthQuantile(Turned({4.0, 4.0, 0.0}), 0.95, kKnown), 2.0 * 2.447747, 1e-5);
  EXPECT_NEAR(LengthQuantile(Turned({4.0, 4.0, 4.0}), 0.95, kKnown), 2.0 * 2.795483, 1e-5);
}

// Of an estimated covariance: t = 2.2281 on a line, sqrt(3 F) with F = 3.7083 in space.
TEST(ErrorLength, IsStudentsAndFishersWhereTheCovarianceIsEstimated) {
  EXPECT_NEAR(LengthQuantile(Turned({1.0, 0.0, 0.0}), 0.95, 10.0), 2.228139, 1e-5);
  EXPECT_NEAR(LengthQuantile(Turned({1.0, 1.0, 1.0}), 0.95, 10.0), std::sqrt(3 * 3.708265), 1e-5);
}

TEST(ErrorLength, OfAnUnknownCovarianceIsUnknown) {
  Eigen::Matrix3d c = Eigen::Matrix3d::Identity();
  c(1, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(LengthQuantile(c, 0.95, kKnown)));
  EXPECT_TRUE(std::isnan(LengthTail(c, 1.0, kKnown)));
}

TEST(ErrorLength, OfNoErrorIsZeroAndScalesWithIt) {
  EXPECT_EQ(LengthQuantile(Eigen::Matrix3d::Zero(), 0.95, kKnown), 0.0);
  const Eigen::Matrix3d c = Turned({1.0, 0.3, 0.05});
  EXPECT_NEAR(
      LengthQuantile(1e-8 * c, 0.95, kKnown), 1e-4 * LengthQuantile(c, 0.95, kKnown), 1e-12);
}

// Imhof's inversion of the characteristic function (Biometrika 48, 1961): an independent road to
// the tail of sum of l_i z_i^2. With nu degrees of freedom the threshold is one more term.
double ImhofTail(const Eigen::Vector3d& variances, double length, double dof) {
  constexpr int kSteps = 400000;
  constexpr double kEnd = 4000.0;
  const auto integrand = [&](double u) {
    double angle = 0.0, log_size = 0.0;
    for (int k = 0; k < 3; ++k) {
      angle += 0.5 * std::atan(variances[k] * u);
      log_size += 0.25 * std::log1p(std::pow(variances[k] * u, 2));
    }
    const double x = length * length;
    if (std::isfinite(dof)) {
      angle -= 0.5 * dof * std::atan(x / dof * u);
      log_size += 0.25 * dof * std::log1p(std::pow(x / dof * u, 2));
    } else {
      angle -= 0.5 * x * u;
    }
    return std::sin(angle) / (u * std::exp(log_size));
  };
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) sum += integrand((i + 0.5) * kEnd / kSteps);
  return 0.5 + sum * kEnd / kSteps / M_PI;
}

TEST(ErrorLength, AgreesWithImhof) {
  for (const Eigen::Vector3d& variances :
       {Eigen::Vector3d(1.0, 0.5, 0.2), Eigen::Vector3d(2.0, 0.9, 0.01)})
    for (const double dof : {kKnown, 7.5, 40.0})
      for (const double length : {0.5, 1.5, 3.0})
        EXPECT_NEAR(
            LengthTail(Turned(variances), length, dof), ImhofTail(variances, length, dof), 2e-5)
            << variances.transpose() << " " << dof << " " << length;
}

TEST(ErrorLength, TailAndQuantileUndoEachOther) {
  for (const double p : {0.5, 0.95, 0.999})
    for (const double dof : {kKnown, 5.0}) {
      const Eigen::Matrix3d c = Turned({3.0, 0.2, 0.001});
      EXPECT_NEAR(LengthTail(c, LengthQuantile(c, p, dof), dof), 1.0 - p, 1e-9);
    }
}

TEST(ErrorLength, IsThatOfDraws) {
  auto rng = testing::SeededByTest();
  const Eigen::Matrix3d c = Turned({1.0, 0.25, 0.04});
  const Eigen::Matrix3d root = c.llt().matrixL();
  const double limit = LengthQuantile(c, 0.95, kKnown);
  constexpr int kDraws = 200000;
  int longer = 0;
  for (int i = 0; i < kDraws; ++i)
    longer += (root * Eigen::Vector3d(testing::Normal(rng, 3))).norm() > limit;
  // four standard errors
  EXPECT_NEAR(static_cast<double>(longer) / kDraws, 0.05, 4.0 * std::sqrt(0.05 * 0.95 / kDraws));
}

}  // namespace
}  // namespace hexcal
