// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/linear_algebra.h"

#include "testing/matchers.h"
#include "testing/random.h"

namespace hexcal {
namespace {

using testing::MatrixNear;
using testing::SeededByTest;

template <typename Rng>
Eigen::MatrixXd RandomMatrix(Rng& rng, int rows, int cols) {
  Eigen::MatrixXd m(rows, cols);
  for (int i = 0; i < cols; ++i) m.col(i) = testing::Normal(rng, rows);
  return m;
}

TEST(LinearAlgebra, SingularValuesRebuildTheMatrixLargestFirst) {
  auto rng = SeededByTest();
  const Eigen::MatrixXd m = RandomMatrix(rng, 9, 9);
  const SingularValues svd = Decompose(m);
  EXPECT_TRUE(MatrixNear(svd.u * svd.singular_values.asDiagonal() * svd.v.transpose(), m, 1e-13));
  for (int i = 1; i < 9; ++i) EXPECT_GE(svd.singular_values[i - 1], svd.singular_values[i]);
}

TEST(LinearAlgebra, EigenvaluesRebuildASymmetricMatrixSmallestFirst) {
  auto rng = SeededByTest();
  const Eigen::MatrixXd a = RandomMatrix(rng, 7, 7), m = a + a.transpose();
  const Eigenvalues eigen = DecomposeSymmetric(m);
  EXPECT_TRUE(
      MatrixNear(eigen.vectors * eigen.values.asDiagonal() * eigen.vectors.transpose(), m, 1e-13));
  for (int i = 1; i < 7; ++i) EXPECT_LE(eigen.values[i - 1], eigen.values[i]);
}

TEST(LinearAlgebra, PseudoInverseInvertsTheRangeAndLeavesTheRestAtZero) {
  auto rng = SeededByTest();
  const Eigen::MatrixXd a = RandomMatrix(rng, 6, 4), m = a * a.transpose();  // rank 4
  const Eigen::MatrixXd inverse = PseudoInverse(m, 1e-10);
  EXPECT_TRUE(MatrixNear(m * inverse * m, m, 1e-12 * m.norm()));
  EXPECT_TRUE(MatrixNear(inverse * m * inverse, inverse, 1e-12 * inverse.norm()));
}

TEST(LinearAlgebra, ShortestSolutionIsTheOneWithoutAPartThatDoesNothing) {
  Eigen::MatrixXd a(2, 3);
  a << 1, 1, 0, 0, 0, 2;
  const Eigen::VectorXd x = ShortestSolution(a, Eigen::Vector2d(2, 6), 1e-10);
  EXPECT_TRUE(MatrixNear(x, Eigen::Vector3d(1, 1, 3), 1e-14));
}

TEST(LinearAlgebra, TriangularFactorHasTheSameNormalMatrix) {
  auto rng = SeededByTest();
  const Eigen::MatrixXd a = RandomMatrix(rng, 30, 5), r = TriangularFactor(a);
  EXPECT_TRUE(MatrixNear(r.transpose() * r, a.transpose() * a, 1e-12));
  EXPECT_EQ(r(3, 1), 0.0);
}

}  // namespace
}  // namespace hexcal
