// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/information.h"

#include <Eigen/LU>

#include "testing/matchers.h"
#include "testing/random.h"

namespace hexcal {
namespace {

using testing::MatrixNear;
using testing::Normal;
using testing::SeededByTest;

template <typename Rng>
Eigen::MatrixXd RandomRows(Rng& rng, int rows, int parameters) {
  Eigen::MatrixXd m(rows, parameters);
  for (int i = 0; i < rows; ++i) m.row(i) = Normal(rng, parameters).transpose();
  return m;
}

InverseInformation InverseOf(const Eigen::MatrixXd& rows, double smallest_ratio = 1e-10) {
  RowFactor factor(rows.cols());
  factor.Add(rows);
  return Invert(Analyse(factor.R()), smallest_ratio);
}

// y = a + b x at x = 0..4, sigma 1: J'J = [5 10; 10 30].
TEST(Information, OfAStraightLineByHand) {
  Eigen::MatrixXd rows(5, 2);
  rows << 1, 0, 1, 1, 1, 2, 1, 3, 1, 4;
  const InverseInformation inverse = InverseOf(rows);
  EXPECT_EQ(inverse.rank, 2);
  EXPECT_TRUE(MatrixNear(inverse.covariance, Eigen::Matrix2d{{0.6, -0.2}, {-0.2, 0.1}}, 1e-14));
}

// Any number of parameters, and rows that arrive in pieces of any size.
TEST(Information, IsThatOfAllRowsHoweverTheyArrive) {
  auto rng = SeededByTest();
  for (const int p : {1, 3, 12, 31}) {
    const Eigen::MatrixXd rows = RandomRows(rng, 40 * p + 7, p);
    RowFactor factor(p);
    for (Eigen::Index done = 0, piece = 1; done < rows.rows(); done += piece, piece += 3) {
      piece = std::min(piece, rows.rows() - done);
      factor.Add(rows.middleRows(done, piece));
    }
    const Eigen::MatrixXd r = factor.R();
    EXPECT_TRUE(r.isUpperTriangular());
    EXPECT_TRUE(MatrixNear(r.transpose() * r, rows.transpose() * rows, 1e-11 * rows.rows()));
    const InverseInformation inverse = Invert(Analyse(r), 1e-10);
    EXPECT_EQ(inverse.rank, p);
    EXPECT_TRUE(MatrixNear(
        inverse.covariance * (rows.transpose() * rows), Eigen::MatrixXd::Identity(p, p), 1e-11));
  }
}

// Columns scaled to unit length: neither rank nor singular values nor relative digits depend on
// units, here 1e-9 to 1e9.
TEST(Information, DoesNotDependOnUnits) {
  auto rng = SeededByTest();
  const Eigen::MatrixXd rows = RandomRows(rng, 60, 7);
  Eigen::VectorXd unit(7);
  for (int i = 0; i < 7; ++i) unit[i] = std::pow(10.0, 3 * i - 9);
  const InverseInformation plain = InverseOf(rows);
  const InverseInformation scaled = InverseOf(rows * unit.asDiagonal());
  EXPECT_EQ(scaled.rank, 7);
  EXPECT_TRUE(MatrixNear(
      unit.asDiagonal() * scaled.covariance * unit.asDiagonal(), plain.covariance, 1e-14));
}

// A direction that no row sees has no variance, and the rest is as if it were held.
TEST(Information, LosesWhatNoRowSees) {
  Eigen::MatrixXd rows(4, 3);  // the sum of the last two alone is seen
  rows << 1, 1, 1, 1, 2, 2, 1, 3, 3, 1, 4, 4;
  const Information information = Analyse(rows);
  const InverseInformation inverse = Invert(information, 1e-10);
  EXPECT_EQ(inverse.rank, 2);
  EXPECT_TRUE(MatrixNear(information.directions.col(2).normalized().cwiseAbs(),
                         Eigen::Vector3d(0, std::sqrt(0.5), std::sqrt(0.5)),
                         1e-14));
  EXPECT_TRUE(
      MatrixNear(inverse.covariance * Eigen::Vector3d(0, 1, -1), Eigen::Vector3d::Zero(), 1e-13));
  const InverseInformation sum = InverseOf(rows.leftCols(2));
  EXPECT_NEAR(inverse.covariance(0, 0), sum.covariance(0, 0), 1e-13);
  EXPECT_NEAR(4 * inverse.covariance(1, 1), sum.covariance(1, 1), 1e-13);
}

TEST(Information, OfFewerRowsThanParametersHasTheRankOfTheRows) {
  auto rng = SeededByTest();
  const InverseInformation inverse = InverseOf(RandomRows(rng, 2, 5));
  EXPECT_EQ(inverse.rank, 2);
  EXPECT_TRUE(inverse.covariance.allFinite());
  EXPECT_EQ(InverseOf(Eigen::MatrixXd::Zero(3, 3)).rank, 0);
}

}  // namespace
}  // namespace hexcal
