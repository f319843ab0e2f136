// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/covariance.h"

#include <gtest/gtest.h>

#include <limits>

#include "testing/random.h"

namespace hexcal {
namespace {

using testing::SeededByTest;

TEST(IsCovariance, IsOfAnyUnitsAndAnyRank) {
  auto rng = SeededByTest();
  Eigen::MatrixXd root(5, 3);
  for (int i = 0; i < 3; ++i) root.col(i) = testing::Normal(rng, 5);
  const Eigen::VectorXd units = (Eigen::VectorXd(5) << 1e-12, 1.0, 1e6, 1e-3, 1e9).finished();
  const Eigen::MatrixXd rank3 = root * root.transpose();
  EXPECT_TRUE(IsCovariance(rank3));
  EXPECT_TRUE(IsCovariance(units.asDiagonal() * rank3 * units.asDiagonal()));
  EXPECT_TRUE(IsCovariance(Eigen::MatrixXd::Zero(12, 12)));
}

TEST(IsCovariance, IsNotWhatNothingVariesBy) {
  Eigen::Matrix2d m;
  m << 1.0, 1.01, 1.01, 1.0;  // a correlation above one
  EXPECT_FALSE(IsCovariance(m));
  m << 1.0, 0.5, 0.4, 1.0;
  EXPECT_FALSE(IsCovariance(m));
  m << 1.0, 0.0, 0.0, -1e-30;
  EXPECT_FALSE(IsCovariance(m));
  m << 1.0, 1e-30, 1e-30, 0.0;
  EXPECT_FALSE(IsCovariance(m));
  m << 1.0, 0.0, 0.0, std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(IsCovariance(m));
  // Each two of the three may be; the three together not: 1 - 2 0.9 < 0.
  Eigen::Matrix3d three;
  three << 1, 0.9, 0.9, 0.9, 1, -0.9, 0.9, -0.9, 1;
  EXPECT_FALSE(IsCovariance(three));
  EXPECT_FALSE(IsCovariance(Eigen::MatrixXd::Ones(2, 3)));
}

}  // namespace
}  // namespace hexcal
