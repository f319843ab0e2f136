// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/pose_check.h"

#include <Eigen/Cholesky>
#include <cmath>

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

}  // namespace

std::vector<PoseCheck> CheckPoses(const Observations& observations,
                                  const BaseAndTool& mounts,
                                  const NoiseLevels& levels,
                                  double alpha,
                                  double power) {
  const Matrix12d covariance = CovarianceOfFit(observations, mounts, levels);
  const double count = static_cast<double>(observations.items.size());
  const double of_one = -std::expm1(std::log1p(-alpha) / count);  // Sidak
  const double noncentrality = ChiSquareNoncentrality(of_one, power, kDof);

  std::vector<PoseCheck> checks;
  for (const Observation& o : observations.items) {
    const LinearisedError at_fit = Linearise(o, mounts);
    const Matrix6d noise = ErrorCovariance(o, observations, mounts.platform_from_tool, levels);
    const auto deletion = ErrorAgainstOthers(at_fit, noise, covariance, true);
    if (!deletion) continue;
    const Matrix6d of_fit = at_fit.jacobian * covariance * at_fit.jacobian.transpose();
    const Matrix6d information = deletion->covariance.llt().solve(Matrix6d::Identity());
    checks.push_back({o.label,
                      deletion->error,
                      deletion->Squared(),
                      std::sqrt(deletion->covariance.diagonal().head<3>().sum()),
                      std::sqrt(deletion->covariance.diagonal().tail<3>().sum()),
                      Longest(information.topLeftCorner<3, 3>(), noncentrality),
                      Longest(information.bottomRightCorner<3, 3>(), noncentrality),
                      1.0 - noise.llt().solve(of_fit).trace() / kDof});
  }
  return checks;
}

}  // namespace hexcal
