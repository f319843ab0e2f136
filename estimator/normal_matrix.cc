// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/normal_matrix.h"

#include <Eigen/Cholesky>

#include "estimator/spd_factor.h"
#include "geometry/linear_algebra.h"

namespace hexcal {
namespace {

constexpr int kBaseAndTool = 12;
constexpr double kRankThreshold = 1e-12;
// Squared pivots of columns of unit length: above it the triangular factor tells the rank.
constexpr double kSafePivot = 1e-8;
// Of eigenvalues: squares of singular values.
constexpr double kKeptShare = 1e-8;

Eigen::MatrixXd WithUnitDiagonal(const Eigen::MatrixXd& normal, const Eigen::VectorXd& norms) {
  const Eigen::VectorXd scale = norms.cwiseInverse();
  return scale.asDiagonal() * normal * scale.asDiagonal();
}

// Without eigenvalues: of a matrix with a diagonal of ones the smallest is no less than one over
// the trace of the inverse, the largest no more than the trace.
bool SurelyKeepsItsWeakest(const Eigen::MatrixXd& normal) {
  if (normal.rows() != kBaseAndTool) return false;
  const SpdFactor<kBaseAndTool> factor(normal);
  if (!(factor.smallest_pivot() > kSafePivot)) return false;
  const double trace = factor.Inverse().diagonal().dot(normal.diagonal());
  return 1.0 / trace > kKeptShare * kBaseAndTool;
}

}  // namespace

Eigen::MatrixXd InverseOfNormal(const Eigen::MatrixXd& normal,
                                const Eigen::VectorXd& column_norms) {
  const Eigen::VectorXd scale =
      column_norms.unaryExpr([](double norm) { return norm > 0 ? 1.0 / norm : 1.0; });
  const Eigen::MatrixXd scaled = scale.asDiagonal() * normal * scale.asDiagonal();
  return scale.asDiagonal() * PseudoInverse(scaled, kRankThreshold) * scale.asDiagonal();
}

Eigen::MatrixXd InverseOfNormal(const Eigen::MatrixXd& normal) {
  if (normal.rows() == kBaseAndTool) {
    const SpdFactor<kBaseAndTool> factor(normal);
    if (factor.smallest_pivot() > kSafePivot) return factor.Inverse();
  }
  const Eigen::VectorXd norms = normal.diagonal().cwiseSqrt();
  if (!(norms.minCoeff() > 0)) return InverseOfNormal(normal, norms);
  const Eigen::VectorXd scale = norms.cwiseInverse();
  const Eigen::LLT<Eigen::MatrixXd> cholesky(WithUnitDiagonal(normal, norms));
  if (cholesky.info() != Eigen::Success ||
      !(cholesky.matrixLLT().diagonal().array().square().minCoeff() > kSafePivot))
    return InverseOfNormal(normal, norms);
  const Eigen::Index p = norms.size();
  return scale.asDiagonal() * cholesky.solve(Eigen::MatrixXd::Identity(p, p)) * scale.asDiagonal();
}

bool KeepsItsWeakest(const Eigen::MatrixXd& normal) {
  if (SurelyKeepsItsWeakest(normal)) return true;
  const Eigen::VectorXd norms = normal.diagonal().cwiseSqrt();
  if (!(norms.minCoeff() > 0)) return false;
  const Eigen::VectorXd values = DecomposeSymmetric(WithUnitDiagonal(normal, norms)).values;
  return values[0] > kKeptShare * values[norms.size() - 1];
}

Eigen::VectorXd GaussNewtonStep(const NormalEquations& equations) {
  return -InverseOfNormal(equations.normal) * equations.gradient;
}

}  // namespace hexcal
