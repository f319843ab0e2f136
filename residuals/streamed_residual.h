// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

namespace hexcal {

// Rows whose errors share one unknown variance, as if it were one: what the residuals' sums would
// be at another is told without another pass.
struct VarianceComponent {
  Eigen::MatrixXd normal;     // J' J, p x p
  Eigen::VectorXd gradient;   // J' e
  double squared_norm = 0.0;  // e' e
  double rows = 0.0;
};

// All that least squares needs to know of a set of residuals at one point. r: the whitened
// residuals, dimensionless, J their derivative by the small motions of the parameters, in the order
// of the parameter blocks. Under a robust loss rho every row carries the root of its weight rho'.
struct NormalEquations {
  Eigen::MatrixXd normal;     // J' J, p x p, both triangles
  Eigen::VectorXd gradient;   // J' r, p
  double squared_norm = 0.0;  // r' r; the sum of rho(s) under a robust loss
  // Of the poses' errors, not weighted, for the record of an iteration: sums of squares, m^2 and
  // rad^2, and how many poses.
  double position_squares = 0.0;
  double orientation_squares = 0.0;
  long poses = 0;
  // Empty, or what all rows consist of: normal is the sum of theirs by inverse variance.
  std::vector<VarianceComponent> components = {};
};

// Residuals of which no row is ever stored: one pass gives their normal equations. What Ceres sees
// of them is StreamedCost (residuals/streamed_cost.h).
class StreamedResidual {
 public:
  virtual ~StreamedResidual() = default;

  // world_from_base and platform_from_tool come first, 7 parameters each; then what else this
  // residual has to estimate: 7 for a pose on PoseManifold, else a Euclidean block of that size.
  virtual std::vector<int> BlockSizes() const = 0;

  // parameters: one pointer a block.
  virtual NormalEquations Evaluate(double const* const* parameters) const = 0;
};

// Small motions of a block of that size: 6 for a pose.
inline int BlockDof(int block_size) { return block_size == 7 ? 6 : block_size; }

}  // namespace hexcal
