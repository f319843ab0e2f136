// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/normal_matrix.h"

#include "geometry/linear_algebra.h"
#include "testing/matchers.h"
#include "testing/random.h"

namespace hexcal {
namespace {

using testing::MatrixNear;
using testing::SeededByTest;

// J' J of p columns in units of all sizes, the last of which is the sum of two others but for a
// share.
template <typename Rng>
Eigen::MatrixXd WeakNormal(Rng& rng, int p, double share) {
  Eigen::MatrixXd j = Eigen::Map<const Eigen::MatrixXd>(testing::Normal(rng, 40 * p).data(), 40, p);
  j.col(p - 1) = j.col(0) + j.col(3) + share * j.col(p - 1);
  for (int k = 0; k < p; ++k) j.col(k) *= std::pow(10.0, k % 5 - 2);
  return j.transpose() * j;
}

Eigen::MatrixXd WithUnitDiagonal(const Eigen::MatrixXd& m) {
  const Eigen::VectorXd scale = m.diagonal().cwiseSqrt().cwiseInverse();
  return scale.asDiagonal() * m * scale.asDiagonal();
}

// 12 columns, base and tool's, have a short way of their own.
TEST(NormalMatrix, InverseIsOneForAnyNumberOfColumns) {
  auto rng = SeededByTest();
  for (const int p : {5, 11, 12, 13, 20})
    for (const double share : {1.0, 1e-2}) {
      const Eigen::MatrixXd m = WeakNormal(rng, p, share);
      const Eigen::VectorXd norms = m.diagonal().cwiseSqrt();
      const Eigen::MatrixXd unit =
          norms.asDiagonal() * InverseOfNormal(m) * norms.asDiagonal() * WithUnitDiagonal(m);
      EXPECT_TRUE(MatrixNear(unit, Eigen::MatrixXd::Identity(p, p), 1e-13 / (share * share)));
    }
}

// A direction that is not there stays out of the inverse.
TEST(NormalMatrix, InverseLeavesALostDirectionAtZero) {
  auto rng = SeededByTest();
  for (const int p : {11, 12}) {
    const Eigen::MatrixXd m = WeakNormal(rng, p, 0.0);
    const Eigen::MatrixXd inverse = InverseOfNormal(m);
    const Eigen::VectorXd scale = m.diagonal().cwiseSqrt();
    const Eigen::MatrixXd scaled = scale.asDiagonal() * inverse * scale.asDiagonal();
    EXPECT_TRUE(
        MatrixNear(WithUnitDiagonal(m) * scaled * WithUnitDiagonal(m), WithUnitDiagonal(m), 1e-9));
    EXPECT_LT(scaled.cwiseAbs().maxCoeff(), 1e3);
  }
}

TEST(NormalMatrix, KeepsItsWeakestWhereTheEigenvaluesSaySo) {
  auto rng = SeededByTest();
  int kept = 0, lost = 0;
  for (const int p : {9, 12})
    for (double share = 1.0; share > 1e-7; share *= 0.3) {
      const Eigen::MatrixXd m = WeakNormal(rng, p, share);
      const Eigen::VectorXd values = DecomposeSymmetric(WithUnitDiagonal(m)).values;
      const bool keeps = values[0] > 1e-8 * values[p - 1];
      EXPECT_EQ(KeepsItsWeakest(m), keeps) << p << " columns, share " << share;
      keeps ? ++kept : ++lost;
    }
  EXPECT_GT(kept, 10);
  EXPECT_GT(lost, 10);
}

}  // namespace
}  // namespace hexcal
