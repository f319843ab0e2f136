// SPDX-License-Identifier: BSD-3-Clause
#include "discovery/design_rows.h"

#include <glog/logging.h>

namespace hexcal {
namespace {

Eigen::VectorXd Lengthened(const Eigen::VectorXd& weights, int poses) {
  Eigen::VectorXd all = Eigen::VectorXd::Ones(poses);
  const Eigen::Index known = std::min<Eigen::Index>(weights.size(), poses);
  all.head(known) = weights.head(known);
  return all;
}

}  // namespace

DesignRows MakeDesignRows(const LinearProblem& problem, const GapNoise& noise) {
  GapNoise apart = noise;
  apart.weight = Lengthened(noise.weight, problem.poses);
  apart.shape_weight = Lengthened(noise.shape_weight, problem.poses);
  apart.correlation = apart.shape_correlation = 0.0;
  const Eigen::MatrixXd pose_nuisance = WhitenPoseRows(problem, apart, problem.nuisance);
  const Eigen::MatrixXd pose_columns = WhitenPoseRows(problem, apart, *problem.columns);
  const Eigen::MatrixXd shape_nuisance = WhitenShapeRows(problem, apart, problem.shape_nuisance);
  const Eigen::MatrixXd shape_columns = WhitenShapeRows(problem, apart, *problem.shape_columns);

  DesignRows rows;
  const Eigen::Index all = problem.error.size() + problem.shape_error.size();
  rows.nuisance.setZero(all, problem.nuisance.cols());
  rows.columns.setZero(all, problem.columns->cols());
  int at = 0, shape_at = 0;
  for (int pose = 0; pose < problem.poses; ++pose) {
    rows.first.push_back(at);
    rows.nuisance.middleRows(at, 6) = pose_nuisance.middleRows(6 * pose, 6);
    rows.columns.middleRows(at, 6) = pose_columns.middleRows(6 * pose, 6);
    at += 6;
    const int shapes = problem.shape_freedom.empty() ? 0 : problem.shape_freedom[pose];
    if (shapes == 0) continue;
    rows.nuisance.middleRows(at, shapes) = shape_nuisance.middleRows(shape_at, shapes);
    for (std::size_t k = 0; k < problem.shape_of.size(); ++k)
      if (problem.shape_of[k] >= 0)
        rows.columns.col(static_cast<Eigen::Index>(k)).segment(at, shapes) =
            shape_columns.col(problem.shape_of[k]).segment(shape_at, shapes);
    at += shapes, shape_at += shapes;
  }
  rows.first.push_back(at);
  CHECK_EQ(at, all);
  return rows;
}

Eigen::MatrixXd RowsOf(const DesignRows& rows,
                       const Eigen::MatrixXd& m,
                       const std::vector<int>& poses) {
  Eigen::Index count = 0;
  for (const int pose : poses) count += rows.first[pose + 1] - rows.first[pose];
  Eigen::MatrixXd some(count, m.cols());
  Eigen::Index at = 0;
  for (const int pose : poses) {
    const int size = rows.first[pose + 1] - rows.first[pose];
    some.middleRows(at, size) = m.middleRows(rows.first[pose], size);
    at += size;
  }
  return some;
}

}  // namespace hexcal
