// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>

#include "estimator/grown_solution.h"

namespace hexcal {

// The noise of positions and of orientations was estimated from what a joint fit leaves: what that
// means for its covariance. Two levels, each with the factor that its own residuals ask for; the
// error of the weights adds to that of the estimate (M. G. Kenward and J. H. Roger 1997;
// intervals.h has the same for base and tool alone).
struct GrownLevels {
  // Of the 12 and the free numbers, without the tracker's common error: to be used, and of it the
  // part by level, position first, as whitened by the fit.
  Eigen::MatrixXd covariance;
  std::array<Eigen::MatrixXd, 2> by_level;
  Eigen::Matrix2d of_levels;  // covariance of the two factors

  // Degrees of freedom with which the trace of j covariance j' is known (Satterthwaite).
  double FreedomOf(const Eigen::MatrixXd& j) const;
};
GrownLevels LevelsOf(const GrownSolution& solution);

}  // namespace hexcal
