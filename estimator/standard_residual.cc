// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/standard_residual.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "estimator/certificate.h"
#include "estimator/judge_common.h"
#include "estimator/normal_matrix.h"
#include "residuals/whitener.h"

namespace hexcal {
namespace {

constexpr double kLeast = 0.01;  // of a variance: less is taken for nothing
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

Vector6d Standard(const Vector6d& error, const Matrix6d& whitener, const Matrix6d& of_fit) {
  const Vector6d white = whitener * error;
  const Vector6d taken = (whitener * of_fit * whitener.transpose()).diagonal();
  Vector6d standard;
  for (int k = 0; k < 6; ++k) {
    const double left = 1.0 - taken[k];
    standard[k] = left > kLeast ? white[k] / std::sqrt(left) : kNaN;
  }
  return standard;
}

// Those that the estimate was weighted by.
NoiseLevels LevelsOfTool(const Observations& observations, const Estimate& estimate) {
  const bool is_given = !observations.tool_noise_is_known && !estimate.noise.estimated;
  if (!is_given || !observations.has_robot_noise)
    return LevelsOf(observations, std::nullopt, estimate);
  const Vector6d robot = RobotVariance(observations, estimate.mounts);
  const NoiseSummary& both = estimate.noise;
  return {std::sqrt(std::max(0.0, both.position * both.position - robot.head<3>().mean())),
          std::sqrt(std::max(0.0, both.orientation * both.orientation - robot.tail<3>().mean()))};
}

}  // namespace

Vector6d StandardResidual(const Vector6d& error, const Matrix6d& noise, const Matrix6d& of_fit) {
  return Standard(error, WhitenerOf(noise), of_fit);
}

std::vector<Vector6d> StandardResiduals(const Observations& observations,
                                        const Estimate& estimate) {
  CHECK_EQ(estimate.poses.size(), observations.items.size());
  if (!(estimate.noise.position > 0.0) || !(estimate.noise.orientation > 0.0)) return {};
  const NoiseLevels levels = LevelsOfTool(observations, estimate);
  const auto whitener_of = [&](const Observation& o) {
    return WhitenerOf(ErrorCovariance(o, observations, estimate.mounts.platform_from_tool, levels));
  };
  Matrix12d normal = Matrix12d::Zero();
  for (std::size_t i = 0; i < estimate.poses.size(); ++i) {
    if (!(estimate.poses[i].weight > 0.0)) continue;
    const Observation& o = observations.items[i];
    const Matrix6x12d white = whitener_of(o) * Linearise(o, estimate.mounts).jacobian;
    normal += white.transpose() * white;
  }
  const Matrix12d covariance = InverseOfNormal(normal);
  // Computed again rather than kept: of a million poses they would take a gigabyte.
  std::vector<Vector6d> standard(estimate.poses.size(), Vector6d::Constant(kNaN));
  for (std::size_t i = 0; i < estimate.poses.size(); ++i) {
    if (!(estimate.poses[i].weight > 0.0)) continue;
    const Observation& o = observations.items[i];
    const Matrix6x12d jacobian = Linearise(o, estimate.mounts).jacobian;
    standard[i] = Standard(
        estimate.poses[i].residual, whitener_of(o), jacobian * covariance * jacobian.transpose());
  }
  return standard;
}

}  // namespace hexcal
