// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "residuals/marker_data.h"

namespace hexcal {

struct MarkerReference {
  std::vector<Eigen::VectorXd> parameters;  // as in MarkerLayout, a vector a block
  Eigen::MatrixXd covariance;               // of all of these, tangent space; empty: singular
  double squared_norm = 0.0;
  bool converged = false;
  std::string message;
};

// The likelihood of MarkerBatch as a plain Ceres problem, to hold that one against: a residual
// block with automatic derivatives a reading, every nuisance a parameter block, which Ceres
// eliminates (DENSE_SCHUR); the covariance is ceres::Covariance of the whole problem.
MarkerReference SolveMarkerReference(const MarkerData& data,
                                     const Eigen::Vector3d& sigma,
                                     std::vector<Eigen::VectorXd> start);

}  // namespace hexcal
