// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "discovery/linear_problem.h"

namespace hexcal {

// What the noise of a problem was found to be. The covariance of pose k is
//   (sum over c of factor[c] components[c][k]) / weight[k],
// whitened errors of neighbouring poses have the given correlation.
struct GapNoise {
  std::vector<double> factor;
  Eigen::VectorXd weight;     // one a pose; all 1: Gaussian
  double tail_freedom = 0.0;  // of Student's t that the weights follow; 0: Gaussian
  double correlation = 0.0;
  double shape_factor = 1.0;  // on the variance of shape rows
  Eigen::VectorXd shape_weight;
  double shape_correlation = 0.0;  // of a marker's readings from one pose to the next
  // -2 ln of the likelihood of pose and shape rows (Gaussian part), to compare noises of one
  // problem.
  double deviance = 0.0;

  // Lower Cholesky factor of pose k's covariance, without the correlation.
  Matrix6d Root(const LinearProblem& problem, int pose) const;
};

// Rows of m (6 a pose) whitened.
Eigen::MatrixXd WhitenPoseRows(const LinearProblem& problem,
                               const GapNoise& noise,
                               const Eigen::MatrixXd& m);
Eigen::MatrixXd WhitenShapeRows(const LinearProblem& problem,
                                const GapNoise& noise,
                                const Eigen::MatrixXd& m);

// Restricted maximum likelihood of the factors, given what the nuisances explain; then Student
// weights where the tails are clearly heavier than Gaussian, and a correlation of neighbours where
// it is clear after all that is linear in the order of the poses (trend: further nuisances for
// this question alone, 6 poses x any) has been taken out. (Searle, Casella and McCulloch 1992,
// chapter 6; Lange, Little and Taylor 1989.)
GapNoise EstimateGapNoise(const LinearProblem& problem, const Eigen::MatrixXd& trend);

}  // namespace hexcal
