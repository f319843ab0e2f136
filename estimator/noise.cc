// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/noise.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <limits>

#include "estimator/covariance.h"

namespace hexcal {
namespace {

constexpr int kMaxIterations = 200;
constexpr double kRelativeTolerance = 1e-13;

// Variances below the rounding of the data say nothing.
NoiseLevels Floor(const Observations& observations) {
  double size = 0.0;
  for (const Observation& o : observations.items)
    size = std::max(
        {size, o.world_from_tool.translation.norm(), o.base_from_platform.translation.norm()});
  const double rounding = std::numeric_limits<double>::epsilon();
  return {rounding * std::max(size, 1e-3), rounding};
}

struct Linearised {
  Vector6d error;
  Matrix6x12d jacobian;
};

std::vector<Linearised> Linearise(const Observations& observations, const BaseAndTool& mounts) {
  std::vector<Linearised> rows;
  rows.reserve(observations.items.size());
  for (const Observation& o : observations.items) {
    const Vector6d e = PoseError(mounts, o.base_from_platform, o.world_from_tool);
    rows.push_back({e, PoseErrorJacobian(e, o.base_from_platform * mounts.platform_from_tool)});
  }
  return rows;
}

// Inverse on the directions that the data determine: the others take no part in the residuals.
Matrix12d PseudoInverse(const Matrix12d& normal) {
  const Vector12d scale = normal.diagonal().cwiseSqrt().cwiseMax(1e-300).cwiseInverse();
  Eigen::CompleteOrthogonalDecomposition<Matrix12d> solver;
  solver.setThreshold(1e-12);
  solver.compute(scale.asDiagonal() * normal * scale.asDiagonal());
  return scale.asDiagonal() * Matrix12d(solver.pseudoInverse()) * scale.asDiagonal();
}

// For both components, the quadratic form y' P V P y and its trace tr(P V), P = C^-1 - C^-1 J N^-1
// J' C^-1.
struct Components {
  double form[2] = {0, 0};
  double trace[2] = {0, 0};
};

Components Evaluate(const Observations& observations,
                    const std::vector<Linearised>& rows,
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
  const Matrix12d inverse = PseudoInverse(normal);
  const Vector12d step = inverse * gradient;
  Components components;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Vector6d weighted = weights[i] * (rows[i].error + rows[i].jacobian * step);
    const Matrix6x12d carried = weights[i] * rows[i].jacobian;
    const Vector6d diagonal =
        weights[i].diagonal() - (carried * inverse).cwiseProduct(carried).rowwise().sum();
    for (int k = 0; k < 2; ++k) {
      components.form[k] += weighted.segment<3>(3 * k).squaredNorm();
      components.trace[k] += diagonal.segment<3>(3 * k).sum();
    }
  }
  return components;
}

}  // namespace

NoiseLevels RoughNoise(const Observations& observations, const BaseAndTool& mounts) {
  double position = 0.0, orientation = 0.0;
  for (const Observation& o : observations.items) {
    const Vector6d e = PoseError(mounts, o.base_from_platform, o.world_from_tool);
    position += e.head<3>().squaredNorm();
    orientation += e.tail<3>().squaredNorm();
  }
  const double coordinates = 3.0 * observations.items.size();
  const NoiseLevels floor = Floor(observations);
  return {std::max(std::sqrt(position / coordinates), floor.position),
          std::max(std::sqrt(orientation / coordinates), floor.orientation)};
}

NoiseLevels EstimateNoise(const Observations& observations,
                          const BaseAndTool& mounts,
                          const NoiseLevels& start) {
  const std::vector<Linearised> rows = Linearise(observations, mounts);
  const NoiseLevels floor = Floor(observations);
  NoiseLevels levels = start;
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    const Components c = Evaluate(observations, rows, mounts.platform_from_tool, levels);
    // At the maximum form = trace for each component; the ratio is the step of the variance.
    const NoiseLevels next = {
        std::max(levels.position * std::sqrt(c.form[0] / c.trace[0]), floor.position),
        std::max(levels.orientation * std::sqrt(c.form[1] / c.trace[1]), floor.orientation)};
    const double change = std::max(std::abs(next.position / levels.position - 1.0),
                                   std::abs(next.orientation / levels.orientation - 1.0));
    levels = next;
    if (change < kRelativeTolerance) break;
  }
  return levels;
}

NoiseLevels EstimateNoiseOfEqualWeights(const Observations& observations,
                                        const BaseAndTool& mounts,
                                        const std::vector<Matrix6d>& error_derivatives) {
  // With H = J M J' S, M = (J' S J)^-1, the sums of squares that the fit leaves have the
  // expectation
  //   E[e_k' e_k] = sum over l of tr(V_k (1-H) V_l (1-H)') variance_l.
  Matrix12d plain[2], once[2], twice[2];
  for (int k = 0; k < 2; ++k) plain[k] = once[k] = twice[k] = Matrix12d::Zero();
  Eigen::Vector2d seen = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i < observations.items.size(); ++i) {
    const Observation& o = observations.items[i];
    const Vector6d e = PoseError(mounts, o.base_from_platform, o.world_from_tool);
    const Matrix6x12d j = PaperJacobian(o.base_from_platform * mounts.platform_from_tool);
    for (int k = 0; k < 2; ++k) {
      const Eigen::Matrix<double, 3, 12> block = j.middleRows<3>(3 * k);
      const Eigen::Matrix<double, 3, 12> carried =
          error_derivatives.empty()
              ? block
              : error_derivatives[i].block<3, 3>(3 * k, 3 * k).transpose() * block;
      plain[k] += block.transpose() * block;
      once[k] += carried.transpose() * block;
      twice[k] += carried.transpose() * carried;
      seen[k] += e.segment<3>(3 * k).squaredNorm();
    }
  }
  const Matrix12d inverse = (once[0] + once[1]).completeOrthogonalDecomposition().pseudoInverse();
  Eigen::Matrix2d expected;
  for (int k = 0; k < 2; ++k)
    for (int l = 0; l < 2; ++l) {
      expected(k, l) = (plain[k] * inverse * twice[l] * inverse.transpose()).trace();
      if (k == l)
        expected(k, l) += 3.0 * observations.items.size() - 2.0 * (inverse * once[k]).trace();
    }
  const Eigen::Vector2d variance = expected.inverse() * seen;
  const NoiseLevels floor = Floor(observations);
  return {std::max(std::sqrt(std::max(variance[0], 0.0)), floor.position),
          std::max(std::sqrt(std::max(variance[1], 0.0)), floor.orientation)};
}

}  // namespace hexcal
