// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/normal_matrix.h"

#include <Eigen/Cholesky>

#include "geometry/linear_algebra.h"

namespace hexcal {
namespace {

constexpr double kRankThreshold = 1e-12;
// Squared pivots of columns of unit length: above it the triangular factor tells the rank.
constexpr double kSafePivot = 1e-8;

}  // namespace

Eigen::MatrixXd InverseOfNormal(const Eigen::MatrixXd& normal,
                                const Eigen::VectorXd& column_norms) {
  const Eigen::VectorXd scale =
      column_norms.unaryExpr([](double norm) { return norm > 0 ? 1.0 / norm : 1.0; });
  const Eigen::MatrixXd scaled = scale.asDiagonal() * normal * scale.asDiagonal();
  return scale.asDiagonal() * PseudoInverse(scaled, kRankThreshold) * scale.asDiagonal();
}

Eigen::MatrixXd InverseOfNormal(const Eigen::MatrixXd& normal) {
  const Eigen::VectorXd norms = normal.diagonal().cwiseSqrt();
  if (!(norms.minCoeff() > 0)) return InverseOfNormal(normal, norms);
  const Eigen::VectorXd scale = norms.cwiseInverse();
  const Eigen::LLT<Eigen::MatrixXd> cholesky(scale.asDiagonal() * normal * scale.asDiagonal());
  if (cholesky.info() != Eigen::Success ||
      !(cholesky.matrixLLT().diagonal().array().square().minCoeff() > kSafePivot))
    return InverseOfNormal(normal, norms);
  const Eigen::Index p = norms.size();
  return scale.asDiagonal() * cholesky.solve(Eigen::MatrixXd::Identity(p, p)) * scale.asDiagonal();
}

Eigen::VectorXd GaussNewtonStep(const NormalEquations& equations) {
  return -InverseOfNormal(equations.normal) * equations.gradient;
}

}  // namespace hexcal
