// SPDX-License-Identifier: BSD-3-Clause
#include "discovery/joint_fit.h"

#include <cmath>

#include "geometry/linear_algebra.h"

namespace hexcal {
namespace {

// Of the scaled normal matrix: directions below it are left alone.
constexpr double kRank = 1e-13;

}  // namespace

JointFit FitJointly(const LinearProblem& problem,
                    const GapNoise& noise,
                    const std::vector<int>& forms,
                    double prior_scale,
                    const Eigen::VectorXd& prior_mean) {
  const LinearProblem with = problem.With(forms);
  const Eigen::MatrixXd pose = WhitenPoseRows(problem, noise, with.nuisance);
  const Eigen::MatrixXd shape = WhitenShapeRows(problem, noise, with.shape_nuisance);
  const Eigen::VectorXd pose_error = WhitenPoseRows(problem, noise, problem.error);
  const Eigen::VectorXd shape_error = WhitenShapeRows(problem, noise, problem.shape_error);

  Eigen::MatrixXd normal = pose.transpose() * pose + shape.transpose() * shape;
  Eigen::VectorXd gradient = pose.transpose() * pose_error + shape.transpose() * shape_error;
  const Eigen::Index mounts = problem.nuisance.cols(), all = normal.cols();
  Eigen::Index at = mounts;
  for (const int f : forms)
    for (int k = 0; k < problem.forms[f].size; ++k, ++at) {
      const double sigma = prior_scale * problem.scale[problem.forms[f].first + k];
      if (!(sigma > 0.0)) continue;
      normal(at, at) += 1.0 / (sigma * sigma);
      if (prior_mean.size() > 0) gradient[at] += prior_mean[at - mounts] / (sigma * sigma);
    }
  // Units differ by orders of magnitude: scale to a unit diagonal.
  Eigen::VectorXd scale = normal.diagonal();
  for (double& s : scale) s = s > 0.0 ? 1.0 / std::sqrt(s) : 0.0;
  const Eigen::MatrixXd scaled = scale.asDiagonal() * normal * scale.asDiagonal();
  const Eigenvalues eigen = DecomposeSymmetric(scaled);
  Eigen::VectorXd inverse = eigen.values;
  for (double& value : inverse) value = value > kRank ? 1.0 / value : 0.0;

  JointFit fit;
  fit.covariance = scale.asDiagonal() * eigen.vectors * inverse.asDiagonal() *
                   eigen.vectors.transpose() * scale.asDiagonal();
  const Eigen::VectorXd x = fit.covariance * gradient;
  fit.mounts = x.head(mounts);
  fit.coefficients = x.tail(all - mounts);
  fit.left = problem.error - with.nuisance * x;
  fit.squares = (pose_error - pose * x).squaredNorm() + (shape_error - shape * x).squaredNorm();
  return fit;
}

}  // namespace hexcal
