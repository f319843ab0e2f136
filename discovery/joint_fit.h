// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "discovery/gap_noise.h"
#include "discovery/linear_problem.h"

namespace hexcal {

// Base, tool and the coefficients of some forms together, by weighted least squares with a Gaussian
// prior on the coefficients.
struct JointFit {
  Eigen::VectorXd mounts;        // of the problem's nuisances
  Eigen::VectorXd coefficients;  // of the forms, one after another
  Eigen::MatrixXd covariance;    // of both together
  Eigen::VectorXd left;          // error of the poses that is left, not whitened
  double squares = 0.0;          // whitened squares that are left, of poses and shapes
};

// prior_scale: the prior's 1-sigma in units of the problem's scale; it holds directions that the
// data do not determine. prior_mean: what the coefficients are pulled to; empty: zero.
JointFit FitJointly(const LinearProblem& problem,
                    const GapNoise& noise,
                    const std::vector<int>& forms,
                    double prior_scale,
                    const Eigen::VectorXd& prior_mean);

}  // namespace hexcal
