// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "estimator/pivot_poses.h"

namespace hexcal {

using Matrix36d = Eigen::Matrix<double, 3, 6>;

// d(PivotError) / d(right perturbation of the pose), and / d(tip, pivot).
Matrix36d PivotPoseJacobian(const TipAndPivot& x);
Matrix36d PivotParameterJacobian(const Pose3d& world_from_tool);

// The maximum likelihood tip: poses are measured with errors in rotation, too, so that the
// coefficients of tip and pivot are no truer than the rest (errors in variables). Each pose is
// moved to one in which the tip is at the pivot, and the weighted squares of these motions are made
// least: Gauss-Newton on poses, tip and pivot together, the poses eliminated (Gauss-Helmert). To
// first order its bias vanishes where that of least squares on [R -1] does not. Reference: E. M.
// Mikhail, F. Ackermann, Observations and Least Squares (1976), ch. 5.
struct PivotFit {
  TipAndPivot x;
  Matrix6d covariance = Matrix6d::Zero();  // of (tip, pivot); zero along what is lost
  double squared_sigmas = 0.0;             // sum over the fitted poses
  int degrees_of_freedom = 0;
  int iterations = 0;
  bool converged = false;

  // Of one pose, whether it was fitted or not.
  struct Row {
    Eigen::Vector3d error;        // what its motion, if any, must make good, axes of frame T, m
    Eigen::Matrix3d noise;        // covariance of error by the pose's own noise
    Eigen::Matrix3d prediction;   // by that of tip and pivot
    Matrix36d jacobian;           // PivotParameterJacobian at the moved pose
    double squared_sigmas = 0.0;  // error' noise^-1 error
  };
  std::vector<Row> rows;  // one a pose
};

struct PivotFitOptions {
  int max_iterations = 100;
  double tolerance = 1e-12;  // of a step, part of the size of the poses' and the tip's extent
};

// covariances: of the poses, one each, all definite. used: those that are fitted. basis: the
// directions along which the tip is sought, as in SolvePivotAlgebraically.
PivotFit FitPivot(const std::vector<PivotPose>& poses,
                  const std::vector<Matrix6d>& covariances,
                  const std::vector<bool>& used,
                  const Eigen::Matrix3Xd& basis,
                  const TipAndPivot& start,
                  const PivotFitOptions& options = {});

}  // namespace hexcal
