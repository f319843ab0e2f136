// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace hexcal {

// A symmetric positive definite matrix as L D L', in plain loops of known length and without memory
// of its own: a calibration of few poses takes longer in Eigen's general solvers than in the poses.
// Made for 9 and 12 rows. For equations of any size and rank see estimator/normal_matrix.h.
template <int kSize>
class SpdFactor {
 public:
  using Matrix = Eigen::Matrix<double, kSize, kSize>;
  using Vector = Eigen::Matrix<double, kSize, 1>;

  explicit SpdFactor(const Matrix& matrix);

  // The least share of a row's own diagonal entry that the rows before it leave, whatever the
  // units: the smallest pivot of the matrix scaled to a diagonal of ones. 0 or NaN: not definite.
  double smallest_pivot() const { return smallest_pivot_; }

  Vector Solve(const Vector& right) const;
  Matrix Inverse() const;

 private:
  double rows_[kSize][kSize];  // D L', upper triangle
  double inverse_pivots_[kSize];
  double smallest_pivot_;
};

extern template class SpdFactor<9>;
extern template class SpdFactor<12>;

}  // namespace hexcal
