// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace hexcal {

// What whitened rows say of p parameters, for any p; estimator/covariance.h gives the 12 of base
// and tool their names.

// Gathers the rows of a whitened Jacobian as their R factor (sequential QR: the singular values are
// those of the whole Jacobian, and nothing is squared).
class RowFactor {
 public:
  explicit RowFactor(Eigen::Index parameters);

  // rows: n x p, any n. Sums are taken in the order of calls.
  void Add(const Eigen::Ref<const Eigen::MatrixXd>& rows);
  Eigen::MatrixXd R();  // upper triangular, p x p

 private:
  void Compress();
  Eigen::MatrixXd rows_;
  Eigen::Index used_ = 0;
};

// The directions in parameter space, best determined first, from the SVD of the rows with their
// columns scaled to unit length (so that the parameters' units do not matter).
struct Information {
  Eigen::VectorXd singular_values;    // largest first
  Eigen::MatrixXd scaled_directions;  // column k in scaled parameters, orthonormal
  Eigen::MatrixXd directions;         // column k in the parameters' units, its largest part > 0
};
Information Analyse(const Eigen::MatrixXd& r_factor);

// (J'J)^-1 within the directions whose singular value exceeds smallest_ratio times the largest,
// zero on the others; their number is rank.
struct InverseInformation {
  Eigen::MatrixXd covariance;
  int rank = 0;
};
InverseInformation Invert(const Information& information, double smallest_ratio);

}  // namespace hexcal
