// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/pose_check.h"

#include <glog/logging.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>
#include <optional>

#include "estimator/deletion.h"
#include "estimator/normal_matrix.h"
#include "estimator/quantiles.h"
#include "geometry/linear_algebra.h"
#include "residuals/whitener.h"

namespace hexcal {
namespace {

constexpr int kDof = 6;
// Part of a pose's variance, the least along any direction, that the fit must leave to it.
constexpr double kSmallestShare = 1e-6;

// The d along the worst direction with d' information d = noncentrality.
double Longest(const Eigen::Matrix3d& information, double noncentrality) {
  return std::sqrt(noncentrality / DecomposeSymmetric(information).values[0]);
}

Matrix12d CovarianceOfFit(const Observations& observations,
                          const BaseAndTool& mounts,
                          const NoiseLevels& levels,
                          const std::vector<double>& weights) {
  Matrix12d normal = Matrix12d::Zero();
  for (std::size_t i = 0; i < observations.items.size(); ++i) {
    const Observation& o = observations.items[i];
    const Matrix6d noise = ErrorCovariance(o, observations, mounts.platform_from_tool, levels);
    const Matrix6x12d whitened = WhitenerOf(noise) * Linearise(o, mounts).jacobian;
    normal += (weights.empty() ? 1.0 : weights[i]) * whitened.transpose() * whitened;
  }
  return InverseOfNormal(normal);
}

// One test of all poses together at alpha: the noncentrality that one pose must have to be found
// with that power.
double NoncentralityFor(std::size_t poses, double alpha, double power) {
  const double of_one = -std::expm1(std::log1p(-alpha) / static_cast<double>(poses));  // Sidak
  return ChiSquareNoncentrality(of_one, power, kDof);
}

// The same of a fit that has the pose with this weight, W' W = noise^-1 and V = W of_fit W':
// W^-1 (1 - weight V)^-1 W e, with I + variance (1 - weight V)^-1 V for its covariance, whitened.
std::optional<DeletionError> ErrorWithoutWeighted(const Vector6d& error,
                                                  const Matrix6d& noise,
                                                  const Matrix6d& of_fit,
                                                  double weight,
                                                  double variance) {
  if (weight == 1.0 && variance == 1.0) return ErrorWithout(error, noise, of_fit);
  const Matrix6d whitener = WhitenerOf(noise);
  const Matrix6d taken = whitener * of_fit * whitener.transpose();
  const Eigen::LLT<Matrix6d> left(Matrix6d::Identity() - weight * taken);
  if (left.info() != Eigen::Success ||
      !(left.matrixLLT().diagonal().cwiseAbs2().minCoeff() > kSmallestShare))
    return std::nullopt;
  const Matrix6d unwhiten = noise * whitener.transpose();
  Matrix6d covariance = Matrix6d::Identity() + variance * left.solve(taken);
  covariance = 0.5 * (covariance + covariance.transpose().eval());
  return DeletionError{unwhiten * left.solve(whitener * error),
                       unwhiten * covariance * unwhiten.transpose()};
}

// of_fit: the covariance of what the fit predicts for the pose. Nothing where no other checks it.
std::optional<PoseCheck> CheckPose(const std::string& label,
                                   const Vector6d& error,
                                   const Matrix6d& noise,
                                   const Matrix6d& of_fit,
                                   double noncentrality,
                                   double weight = 1.0,
                                   double variance = 1.0) {
  const auto deletion = ErrorWithoutWeighted(error, noise, of_fit, weight, variance);
  if (!deletion) return std::nullopt;
  const Matrix6d information = deletion->covariance.llt().solve(Matrix6d::Identity());
  return PoseCheck{label,
                   deletion->error,
                   deletion->Squared(),
                   std::sqrt(deletion->covariance.diagonal().head<3>().sum()),
                   std::sqrt(deletion->covariance.diagonal().tail<3>().sum()),
                   Longest(information.topLeftCorner<3, 3>(), noncentrality),
                   Longest(information.bottomRightCorner<3, 3>(), noncentrality),
                   1.0 - weight * noise.llt().solve(of_fit).trace() / kDof};
}

}  // namespace

std::vector<PoseCheck> CheckPoses(const Observations& observations,
                                  const BaseAndTool& mounts,
                                  const NoiseLevels& levels,
                                  double alpha,
                                  double power,
                                  const WeightedAs& weighted) {
  CHECK(weighted.weights.empty() || weighted.weights.size() == observations.items.size());
  const Matrix12d covariance = CovarianceOfFit(observations, mounts, levels, weighted.weights);
  const double noncentrality = NoncentralityFor(observations.items.size(), alpha, power);
  std::vector<PoseCheck> checks;
  for (std::size_t i = 0; i < observations.items.size(); ++i) {
    const Observation& o = observations.items[i];
    const LinearisedError at_fit = Linearise(o, mounts);
    const Matrix6d noise = ErrorCovariance(o, observations, mounts.platform_from_tool, levels);
    const Matrix6d of_fit = at_fit.jacobian * covariance * at_fit.jacobian.transpose();
    const double weight = weighted.weights.empty() ? 1.0 : weighted.weights[i];
    if (const auto check = CheckPose(
            o.label, at_fit.error, noise, of_fit, noncentrality, weight, weighted.variance))
      checks.push_back(*check);
  }
  return checks;
}

std::vector<PoseCheck> CheckPoses(const GrownSolution& solution, double alpha, double power) {
  const auto at_fit = solution.Problem().Evaluate(solution.fit.mounts, solution.fit.free, true);
  if (!at_fit) return {};
  const double variance = solution.noise_scale * solution.noise_scale;
  const double noncentrality = NoncentralityFor(solution.rows.size(), alpha, power);
  std::vector<PoseCheck> checks;
  for (std::size_t i = 0; i < solution.rows.size(); ++i) {
    const Matrix6d unwhiten =
        solution.data.poses[i].whitener.partialPivLu().solve(Matrix6d::Identity());
    const Eigen::MatrixXd jacobian =
        unwhiten * at_fit->jacobian.middleRows<6>(6 * static_cast<Eigen::Index>(i));
    const Matrix6d of_fit = variance * jacobian * solution.fit.covariance * jacobian.transpose();
    if (const auto check = CheckPose(solution.observations.items[i].label,
                                     at_fit->errors[i],
                                     variance * unwhiten * unwhiten.transpose(),
                                     of_fit,
                                     noncentrality))
      checks.push_back(*check);
  }
  return checks;
}

}  // namespace hexcal
