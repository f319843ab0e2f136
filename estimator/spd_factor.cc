// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/spd_factor.h"

#include <cmath>

#include "residuals/pass_support.h"

namespace hexcal {
namespace {

template <int kSize>
HEXCAL_INLINE void FactoriseAny(double (*rows)[kSize], double* inverse_pivots) {
  for (int j = 0; j < kSize; ++j) {
    inverse_pivots[j] = 1.0 / rows[j][j];
    for (int i = j + 1; i < kSize; ++i) {
      const double factor = rows[j][i] * inverse_pivots[j];
      for (int k = i; k < kSize; ++k) rows[i][k] -= factor * rows[j][k];
    }
  }
}

// right: its rows are replaced by the solution's, all columns together.
template <int kSize, int kColumns>
HEXCAL_INLINE void SolveAny(const double (*rows)[kSize],
                            const double* inverse_pivots,
                            double (*right)[kColumns]) {
  for (int j = 0; j < kSize; ++j) {
    for (int c = 0; c < kColumns; ++c) right[j][c] *= inverse_pivots[j];
    for (int i = j + 1; i < kSize; ++i)
      for (int c = 0; c < kColumns; ++c) right[i][c] -= rows[j][i] * right[j][c];
  }
  for (int i = kSize - 1; i > 0; --i)
    for (int k = 0; k < i; ++k) {
      const double factor = rows[k][i] * inverse_pivots[k];
      for (int c = 0; c < kColumns; ++c) right[k][c] -= factor * right[i][c];
    }
}

// Templates are not made for several processors: these are.
HEXCAL_MULTIVERSION void Factorise(double (*rows)[9], double* p) { FactoriseAny<9>(rows, p); }
HEXCAL_MULTIVERSION void Factorise(double (*rows)[12], double* p) { FactoriseAny<12>(rows, p); }
HEXCAL_MULTIVERSION void SolveRows(const double (*rows)[9], const double* p, double (*right)[1]) {
  SolveAny<9, 1>(rows, p, right);
}
HEXCAL_MULTIVERSION void SolveRows(const double (*rows)[9], const double* p, double (*right)[9]) {
  SolveAny<9, 9>(rows, p, right);
}
HEXCAL_MULTIVERSION void SolveRows(const double (*rows)[12], const double* p, double (*right)[1]) {
  SolveAny<12, 1>(rows, p, right);
}
HEXCAL_MULTIVERSION void SolveRows(const double (*rows)[12], const double* p, double (*right)[12]) {
  SolveAny<12, 12>(rows, p, right);
}

}  // namespace

template <int kSize>
SpdFactor<kSize>::SpdFactor(const Matrix& matrix) {
  for (int i = 0; i < kSize; ++i)
    for (int j = 0; j < kSize; ++j) rows_[i][j] = matrix(j, i);
  Factorise(rows_, inverse_pivots_);
  smallest_pivot_ = 1.0;
  for (int j = 0; j < kSize && !std::isnan(smallest_pivot_); ++j) {
    const double share = matrix(j, j) > 0.0 ? rows_[j][j] / matrix(j, j) : 0.0;
    if (!(share >= smallest_pivot_)) smallest_pivot_ = share;
  }
}

template <int kSize>
typename SpdFactor<kSize>::Vector SpdFactor<kSize>::Solve(const Vector& right) const {
  double x[kSize][1];
  for (int i = 0; i < kSize; ++i) x[i][0] = right[i];
  SolveRows(rows_, inverse_pivots_, x);
  return Eigen::Map<const Vector>(x[0]);
}

template <int kSize>
typename SpdFactor<kSize>::Matrix SpdFactor<kSize>::Inverse() const {
  double x[kSize][kSize] = {};
  for (int i = 0; i < kSize; ++i) x[i][i] = 1.0;
  SolveRows(rows_, inverse_pivots_, x);
  const Eigen::Map<const Matrix> inverse(x[0]);
  return 0.5 * (inverse + inverse.transpose());
}

template class SpdFactor<9>;
template class SpdFactor<12>;

}  // namespace hexcal
