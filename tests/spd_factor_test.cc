// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/spd_factor.h"

#include <Eigen/LU>
#include <limits>

#include "testing/matchers.h"
#include "testing/random.h"

namespace hexcal {
namespace {

using testing::MatrixNear;
using testing::SeededByTest;

template <typename T>
class SpdFactorTest : public ::testing::Test {};

template <int kRows>
struct Size {
  static constexpr int kSize = kRows;
};
using Sizes = ::testing::Types<Size<9>, Size<12>>;
TYPED_TEST_SUITE(SpdFactorTest, Sizes, );

template <int kSize, typename Rng>
Eigen::Matrix<double, kSize, kSize> AnyMatrix(Rng& rng) {
  const Eigen::MatrixXd a = Eigen::Map<const Eigen::MatrixXd>(
      testing::Normal(rng, 2 * kSize * kSize).data(), 2 * kSize, kSize);
  return a.transpose() * a;
}

TYPED_TEST(SpdFactorTest, SolvesAndInverts) {
  constexpr int kSize = TypeParam::kSize;
  auto rng = SeededByTest();
  for (int i = 0; i < 20; ++i) {
    const auto m = AnyMatrix<kSize>(rng);
    const Eigen::Matrix<double, kSize, 1> x = testing::Normal(rng, kSize);
    const SpdFactor<kSize> factor(m);
    EXPECT_TRUE(MatrixNear(factor.Solve(m * x), x, 1e-11));
    EXPECT_TRUE(MatrixNear(factor.Inverse(), Eigen::MatrixXd(m).inverse(), 1e-11));
    EXPECT_TRUE(factor.Inverse() == factor.Inverse().transpose());
  }
}

// A row that is the sum of two others but for a share: the last pivot, in any units.
TYPED_TEST(SpdFactorTest, SmallestPivotTellsAWeakDirection) {
  constexpr int kSize = TypeParam::kSize;
  for (const double share : {1e-2, 1e-6, 1e-10}) {
    Eigen::MatrixXd a = Eigen::MatrixXd::Identity(kSize, kSize);
    a.col(kSize - 1).setZero();
    a(2, kSize - 1) = a(5, kSize - 1) = std::sqrt(0.5 * (1.0 - share));
    a(kSize - 1, kSize - 1) = std::sqrt(share);
    for (int k = 0; k < kSize; ++k) a.col(k) *= std::pow(10.0, k - 5);
    const SpdFactor<kSize> factor(a.transpose() * a);
    EXPECT_NEAR(factor.smallest_pivot(), share, 1e-5 * share + 1e-15);
  }
}

TYPED_TEST(SpdFactorTest, WhatIsNotDefiniteHasNoPivotAboveZero) {
  constexpr int kSize = TypeParam::kSize;
  using Matrix = Eigen::Matrix<double, kSize, kSize>;
  Matrix m = Matrix::Identity();
  m(3, 3) = 0.0;
  EXPECT_FALSE(SpdFactor<kSize>(m).smallest_pivot() > 0.0);
  m(3, 3) = -1.0;
  EXPECT_FALSE(SpdFactor<kSize>(m).smallest_pivot() > 0.0);
  m(3, 3) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(SpdFactor<kSize>(m).smallest_pivot() > 0.0);
  EXPECT_FALSE(SpdFactor<kSize>(Matrix::Zero()).smallest_pivot() > 0.0);
}

}  // namespace
}  // namespace hexcal
