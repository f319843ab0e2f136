// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/pose_check.h"

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

// The d along the worst direction with d' information d = noncentrality.
double Longest(const Eigen::Matrix3d& information, double noncentrality) {
  return std::sqrt(noncentrality / DecomposeSymmetric(information).values[0]);
}

Matrix12d CovarianceOfFit(const Observations& observations,
                          const BaseAndTool& mounts,
                          const NoiseLevels& levels) {
  Matrix12d normal = Matrix12d::Zero();
  for (const Observation& o : observations.items) {
    const Matrix6d noise = ErrorCovariance(o, observations, mounts.platform_from_tool, levels);
    const Matrix6x12d whitened = WhitenerOf(noise) * Linearise(o, mounts).jacobian;
    normal += whitened.transpose() * whitened;
  }
  return InverseOfNormal(normal);
}

// One test of all poses together at alpha: the noncentrality that one pose must have to be found
// with that power.
double NoncentralityFor(std::size_t poses, double alpha, double power) {
  const double of_one = -std::expm1(std::log1p(-alpha) / static_cast<double>(poses));  // Sidak
  return ChiSquareNoncentrality(of_one, power, kDof);
}

// of_fit: the covariance of what the fit predicts for the pose. Nothing where no other checks it.
std::optional<PoseCheck> CheckPose(const std::string& label,
                                   const Vector6d& error,
                                   const Matrix6d& noise,
                                   const Matrix6d& of_fit,
                                   double noncentrality) {
  const auto deletion = ErrorWithout(error, noise, of_fit);
  if (!deletion) return std::nullopt;
  const Matrix6d information = deletion->covariance.llt().solve(Matrix6d::Identity());
  return PoseCheck{label,
                   deletion->error,
                   deletion->Squared(),
                   std::sqrt(deletion->covariance.diagonal().head<3>().sum()),
                   std::sqrt(deletion->covariance.diagonal().tail<3>().sum()),
                   Longest(information.topLeftCorner<3, 3>(), noncentrality),
                   Longest(information.bottomRightCorner<3, 3>(), noncentrality),
                   1.0 - noise.llt().solve(of_fit).trace() / kDof};
}

}  // namespace

std::vector<PoseCheck> CheckPoses(const Observations& observations,
                                  const BaseAndTool& mounts,
                                  const NoiseLevels& levels,
                                  double alpha,
                                  double power) {
  const Matrix12d covariance = CovarianceOfFit(observations, mounts, levels);
  const double noncentrality = NoncentralityFor(observations.items.size(), alpha, power);
  std::vector<PoseCheck> checks;
  for (const Observation& o : observations.items) {
    const LinearisedError at_fit = Linearise(o, mounts);
    const Matrix6d noise = ErrorCovariance(o, observations, mounts.platform_from_tool, levels);
    const Matrix6d of_fit = at_fit.jacobian * covariance * at_fit.jacobian.transpose();
    if (const auto check = CheckPose(o.label, at_fit.error, noise, of_fit, noncentrality))
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
