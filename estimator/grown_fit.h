// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "estimator/grown_problem.h"

namespace hexcal {

struct GrownFitOptions {
  int max_iterations = 100;
  // Of the cost, between steps: 1e-15 is rounding; 1e-10 is 1e-5 sigma of the parameters or so, in
  // half the time.
  double function_tolerance = 1e-15;
  // Of the whitened Jacobian with columns of unit length: singular values below this part of the
  // largest are directions that neither data nor priors determine.
  double smallest_ratio = 1e-9;
};

// Base, tool and effects by joint least squares.
struct GrownFit {
  Mounts mounts;
  std::vector<Effect> effects;  // with their standard deviations; NaN where held or not determined
  Eigen::VectorXd free;         // their free numbers
  // Of the 12 right perturbations of the mounts (the paper's y) and the free numbers, priors in it.
  Eigen::MatrixXd covariance;
  std::vector<bool> determined;  // of the same
  double chi_square = 0.0;       // of the poses
  double misfit_chi_square = 0.0;
  double prior_chi_square = 0.0;
  std::vector<Vector6d> errors;         // measured [-] predicted, [m, rad], frame T, not whitened
  std::vector<Pose3d> predicted, seen;  // world_from_tool
  bool converged = false;
  std::string message;  // why not
  int start = -1;       // which of the starts it came from
};

// The best of the fits from all starts, each a vector of the free numbers; none: from where the
// effects stand. Trust region with exact derivatives.
GrownFit FitGrown(const GrownProblem& problem,
                  const Mounts& mounts,
                  const std::vector<Eigen::VectorXd>& starts,
                  const GrownFitOptions& options);

}  // namespace hexcal
