// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/covariance.h"

#include "geometry/linear_algebra.h"

namespace hexcal {

bool IsCovariance(const Eigen::MatrixXd& m) {
  constexpr double kRounding = 1e-8;
  if (m.rows() != m.cols() || !m.allFinite() || (m.diagonal().array() < 0.0).any()) return false;
  const Eigen::ArrayXd sigma = m.diagonal().array().sqrt();
  Eigen::MatrixXd correlation = m;
  for (Eigen::Index i = 0; i < m.rows(); ++i)
    for (Eigen::Index j = 0; j < m.cols(); ++j) {
      const double scale = sigma[i] * sigma[j];
      if (scale == 0.0 && m(i, j) != 0.0) return false;
      correlation(i, j) = scale == 0.0 ? 0.0 : m(i, j) / scale;
    }
  if (!((correlation - correlation.transpose()).cwiseAbs().maxCoeff() <= kRounding)) return false;
  return DecomposeSymmetric(correlation).values[0] >= -kRounding;
}

}  // namespace hexcal
