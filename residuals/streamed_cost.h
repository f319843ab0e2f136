// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ceres/cost_function.h>

#include <vector>

#include "residuals/streamed_residual.h"

namespace hexcal {

// p + 1 residuals whose sum of squares, gradient and Gauss-Newton matrix are those of all rows:
//   normal = R' R,  r = [R^-T gradient ; sqrt(squared_norm - |R^-T gradient|^2)],  J = [R ; 0].
// Directions that the rows do not determine get rows of zeros.
struct WhitenedRows {
  Eigen::MatrixXd jacobian;  // (p + 1) x p, by small motions
  Eigen::VectorXd residual;  // p + 1
};
WhitenedRows RowsOf(const NormalEquations& equations);

// Ceres's view of a streamed residual: blocks as BlockSizes(), poses on PoseManifold, RowsOf() as
// residuals, so that the trust region and its summary are Ceres's own. One pass a point: a
// point asked for twice in a row is not evaluated again. Not for several threads at once.
class StreamedCost final : public ceres::CostFunction {
 public:
  explicit StreamedCost(const StreamedResidual& residual);  // not owned

  bool Evaluate(double const* const* parameters,
                double* residuals,
                double** jacobians) const override;

  const NormalEquations& At(double const* const* parameters) const;

 private:
  const StreamedResidual& residual_;
  std::vector<int> block_sizes_;
  mutable std::vector<double> point_;  // where equations_ were evaluated
  mutable NormalEquations equations_;
};

}  // namespace hexcal
