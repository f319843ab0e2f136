// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/noise.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "estimator/normal_matrix.h"

namespace hexcal {
namespace {

constexpr int kMaxIterations = 200;
constexpr double kRelativeTolerance = 1e-13;
// A component with less than this share of its residuals left free by the fit cannot be estimated.
constexpr double kSmallestFreeShare = 1e-9;

// For one component, the quadratic form y' P V P y, its trace tr(P V), P = C^-1 - C^-1 J N^-1 J'
// C^-1, and what the trace would be without a fit.
struct Component {
  double form = 0.0;
  double trace = 0.0;
  double trace_without_fit = 0.0;

  // Of its sigma, towards the maximum of the likelihood: there form = trace.
  double Step() const {
    return trace > kSmallestFreeShare * trace_without_fit ? std::sqrt(form / trace) : 1.0;
  }
};

struct Components {
  Component position, orientation;
};

Components Evaluate(const Observations& observations,
                    const std::vector<LinearisedError>& rows,
                    const Pose3d& platform_from_tool,
                    const NoiseLevels& levels) {
  std::vector<Matrix6d> weights(rows.size());
  Matrix12d normal = Matrix12d::Zero();
  Vector12d gradient = Vector12d::Zero();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Matrix6d c =
        ErrorCovariance(observations.items[i], observations, platform_from_tool, levels);
    weights[i] = c.llt().solve(Matrix6d::Identity());
    normal.noalias() += rows[i].jacobian.transpose() * weights[i] * rows[i].jacobian;
    gradient.noalias() -= rows[i].jacobian.transpose() * weights[i] * rows[i].error;
  }
  const Matrix12d inverse = InverseOfNormal(normal);
  const Vector12d step = inverse * gradient;
  Components components;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Vector6d weighted = weights[i] * (rows[i].error + rows[i].jacobian * step);
    const Matrix6x12d carried = weights[i] * rows[i].jacobian;
    const Vector6d before = weights[i].diagonal();
    const Vector6d after = before - (carried * inverse).cwiseProduct(carried).rowwise().sum();
    const auto add = [&](int first, Component* component) {
      component->form += weighted.segment<3>(first).squaredNorm();
      component->trace += after.segment<3>(first).sum();
      component->trace_without_fit += before.segment<3>(first).sum();
    };
    add(0, &components.position);
    add(3, &components.orientation);
  }
  return components;
}

}  // namespace

NoiseLevels EstimateNoise(const Observations& observations,
                          const BaseAndTool& mounts,
                          const NoiseLevels& start) {
  std::vector<LinearisedError> rows;
  rows.reserve(observations.items.size());
  for (const Observation& o : observations.items) rows.push_back(Linearise(o, mounts));
  const NoiseLevels rounding = Rounding(observations.items);
  NoiseLevels levels = start;
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    const Components c = Evaluate(observations, rows, mounts.platform_from_tool, levels);
    const NoiseLevels next = {
        std::max(levels.position * c.position.Step(), rounding.position),
        std::max(levels.orientation * c.orientation.Step(), rounding.orientation)};
    const double change = std::max(std::abs(next.position / levels.position - 1.0),
                                   std::abs(next.orientation / levels.orientation - 1.0));
    levels = next;
    if (change < kRelativeTolerance) break;
  }
  return levels;
}

}  // namespace hexcal
