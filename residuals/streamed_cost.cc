// SPDX-License-Identifier: BSD-3-Clause
#include "residuals/streamed_cost.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "geometry/linear_algebra.h"
#include "residuals/pose_manifold.h"

namespace hexcal {
namespace {

// Squared, of columns of unit length: below it the triangular factor is mostly rounding.
constexpr double kSmallestPivot = 1e-10;
// Eigenvalues below this part of the largest are rounding.
constexpr double kNullEigenvalue = 1e-14;

// R with R' R = normal, and R^-T gradient beside it.
void Factor(const Eigen::MatrixXd& normal,
            const Eigen::VectorXd& gradient,
            Eigen::Ref<Eigen::MatrixXd> r,
            Eigen::Ref<Eigen::VectorXd> carried) {
  const Eigen::VectorXd norms =
      normal.diagonal().unaryExpr([](double n) { return n > 0 ? std::sqrt(n) : 1.0; });
  const Eigen::VectorXd unscale = norms.cwiseInverse();
  const Eigen::MatrixXd scaled = unscale.asDiagonal() * normal * unscale.asDiagonal();
  const Eigen::VectorXd scaled_gradient = unscale.cwiseProduct(gradient);
  const Eigen::LLT<Eigen::MatrixXd> cholesky(scaled);
  const auto l = cholesky.matrixL();
  if (cholesky.info() == Eigen::Success &&
      cholesky.matrixLLT().diagonal().array().square().minCoeff() > kSmallestPivot) {
    r = Eigen::MatrixXd(l).transpose() * norms.asDiagonal();
    carried = l.solve(scaled_gradient);
    return;
  }
  const Eigenvalues eigen = DecomposeSymmetric(scaled);
  for (Eigen::Index k = 0; k < norms.size(); ++k) {
    const double value = eigen.values[k];
    const bool is_null = !(value > kNullEigenvalue * eigen.values[norms.size() - 1]);
    const double root = is_null ? 0.0 : std::sqrt(value);
    r.row(k) = root * eigen.vectors.col(k).cwiseProduct(norms).transpose();
    carried[k] = is_null ? 0.0 : eigen.vectors.col(k).dot(scaled_gradient) / root;
  }
}

}  // namespace

WhitenedRows RowsOf(const NormalEquations& equations) {
  const Eigen::Index p = equations.gradient.size();
  WhitenedRows rows{Eigen::MatrixXd::Zero(p + 1, p), Eigen::VectorXd(p + 1)};
  Factor(equations.normal, equations.gradient, rows.jacobian.topRows(p), rows.residual.head(p));
  rows.residual[p] =
      std::sqrt(std::max(0.0, equations.squared_norm - rows.residual.head(p).squaredNorm()));
  return rows;
}

StreamedCost::StreamedCost(const StreamedResidual& residual)
    : residual_(residual), block_sizes_(residual.BlockSizes()) {
  int rows = 1;
  for (const int size : block_sizes_) {
    mutable_parameter_block_sizes()->push_back(size);
    rows += BlockDof(size);
  }
  set_num_residuals(rows);
}

const NormalEquations& StreamedCost::At(double const* const* parameters) const {
  std::vector<double> point;
  for (std::size_t b = 0; b < block_sizes_.size(); ++b)
    point.insert(point.end(), parameters[b], parameters[b] + block_sizes_[b]);
  if (point != point_) {
    equations_ = residual_.Evaluate(parameters);
    point_ = std::move(point);
  }
  return equations_;
}

bool StreamedCost::Evaluate(double const* const* parameters,
                            double* residuals,
                            double** jacobians) const {
  const NormalEquations& equations = At(parameters);
  if (!std::isfinite(equations.squared_norm) || !equations.normal.allFinite()) return false;
  Eigen::Map<Eigen::VectorXd> r(residuals, num_residuals());
  if (jacobians == nullptr) {  // only the cost is asked for
    r.setZero();
    r[0] = std::sqrt(equations.squared_norm);
    return true;
  }
  const WhitenedRows rows = RowsOf(equations);
  r = rows.residual;
  int column = 0;
  for (std::size_t b = 0; b < block_sizes_.size(); ++b) {
    const int size = block_sizes_[b], dof = BlockDof(size);
    const auto columns = rows.jacobian.middleCols(column, dof);
    column += dof;
    if (jacobians[b] == nullptr) continue;
    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    Eigen::Map<RowMajor> jacobian(jacobians[b], num_residuals(), size);
    if (dof == size) {
      jacobian = columns;
    } else {
      RowMajor motion(dof, size);
      PoseManifold().MinusJacobian(parameters[b], motion.data());
      jacobian = columns * motion;
    }
  }
  return true;
}

}  // namespace hexcal
