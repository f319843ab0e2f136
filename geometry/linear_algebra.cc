// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/linear_algebra.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <Eigen/SVD>

namespace hexcal {
namespace {

Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> Orthogonal(const Eigen::MatrixXd& m,
                                                                   double threshold) {
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> decomposition;
  decomposition.setThreshold(threshold);
  decomposition.compute(m);
  return decomposition;
}

}  // namespace

SingularValues Decompose(const Eigen::MatrixXd& m) {
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(m, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return {svd.singularValues(), svd.matrixU(), svd.matrixV()};
}

Eigenvalues DecomposeSymmetric(const Eigen::MatrixXd& m) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(m);
  return {eigen.eigenvalues(), eigen.eigenvectors()};
}

Eigen::MatrixXd PseudoInverse(const Eigen::MatrixXd& m, double threshold) {
  return Orthogonal(m, threshold).pseudoInverse();
}

Eigen::VectorXd ShortestSolution(const Eigen::MatrixXd& a,
                                 const Eigen::VectorXd& b,
                                 double threshold) {
  return Orthogonal(a, threshold).solve(b);
}

Eigen::MatrixXd TriangularFactor(const Eigen::MatrixXd& a) {
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(a);
  return qr.matrixQR().topRows(a.cols()).triangularView<Eigen::Upper>();
}

Eigen::MatrixXd OrthonormalBasis(const Eigen::MatrixXd& a, double threshold) {
  Eigen::MatrixXd scaled = a;
  Eigen::Index kept = 0;
  for (Eigen::Index k = 0; k < a.cols(); ++k) {
    const double length = a.col(k).norm();
    if (length > 0.0) scaled.col(kept++) = a.col(k) / length;
  }
  if (kept == 0) return Eigen::MatrixXd(a.rows(), 0);
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr;
  qr.setThreshold(threshold);
  qr.compute(scaled.leftCols(kept));
  return qr.householderQ() * Eigen::MatrixXd::Identity(a.rows(), qr.rank());
}

}  // namespace hexcal
