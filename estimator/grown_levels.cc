// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/grown_levels.h"

#include <glog/logging.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

namespace hexcal {

double GrownLevels::FreedomOf(const Eigen::MatrixXd& j) const {
  Eigen::Vector2d by_factor;
  for (int level : {0, 1}) by_factor[level] = (j * by_level[level] * j.transpose()).trace();
  const double variance = by_factor.dot(of_levels * by_factor);
  const double trace = (j * covariance * j.transpose()).trace();
  return variance > 0.0 ? 2.0 * trace * trace / variance : std::numeric_limits<double>::infinity();
}

GrownLevels LevelsOf(const GrownSolution& solution) {
  const auto at_fit = solution.Problem().Evaluate(solution.fit.mounts, solution.fit.free, true);
  CHECK(at_fit) << "a solution that cannot be evaluated";
  const Eigen::MatrixXd& fit = solution.fit.covariance;
  std::array<Eigen::MatrixXd, 2> normal;
  Eigen::Vector2d squares = Eigen::Vector2d::Zero(), used;
  const double rows = 3.0 * static_cast<double>(solution.rows.size());
  for (const int level : {0, 1}) {
    normal[level].setZero(fit.rows(), fit.cols());
    for (std::size_t i = 0; i < solution.rows.size(); ++i) {
      const Eigen::Index at = 6 * static_cast<Eigen::Index>(i) + 3 * level;
      const auto jacobian = at_fit->jacobian.middleRows<3>(at);
      normal[level] += jacobian.transpose() * jacobian;
      squares[level] += at_fit->residual.segment<3>(at).squaredNorm();
    }
    used[level] = (fit * normal[level]).trace();
  }
  GrownLevels levels;
  Eigen::Vector2d factor;
  Eigen::Matrix2d information;
  for (const int j : {0, 1}) {
    factor[j] = squares[j] / std::max(rows - used[j], 1.0);
    levels.by_level[j] = fit * normal[j] * fit;
    for (const int k : {0, 1})
      information(j, k) = 0.5 * ((j == k ? rows - 2.0 * used[j] : 0.0) +
                                 (fit * normal[j] * fit * normal[k]).trace());
  }
  // Of factors near one; a factor's own error is in proportion to it.
  levels.of_levels = factor.asDiagonal() * information.inverse() * factor.asDiagonal();
  const Eigen::Matrix2d& s = levels.of_levels;
  levels.covariance = fit;
  for (const int j : {0, 1}) {
    levels.covariance += (factor[j] - 1.0) * levels.by_level[j];
    levels.covariance += 2.0 * s(j, j) * levels.by_level[j];
    for (const int k : {0, 1})
      levels.covariance -= 2.0 * s(j, k) * (fit * normal[j] * fit * normal[k] * fit);
  }
  levels.covariance = 0.5 * (levels.covariance + levels.covariance.transpose()).eval();
  return levels;
}

}  // namespace hexcal
