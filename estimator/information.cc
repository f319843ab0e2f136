// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/information.h"

#include <glog/logging.h>

#include <algorithm>
#include <utility>

#include "geometry/linear_algebra.h"

namespace hexcal {
namespace {

// Rows gathered before a QR decomposition, in units of the number of parameters.
constexpr Eigen::Index kChunk = 16;

}  // namespace

RowFactor::RowFactor(Eigen::Index parameters)
    : rows_(Eigen::MatrixXd::Zero(kChunk * parameters, parameters)) {
  CHECK_GT(parameters, 0);
}

void RowFactor::Add(const Eigen::Ref<const Eigen::MatrixXd>& rows) {
  CHECK_EQ(rows.cols(), rows_.cols());
  for (Eigen::Index done = 0; done < rows.rows();) {
    if (used_ == rows_.rows()) Compress();
    const Eigen::Index now = std::min(rows.rows() - done, rows_.rows() - used_);
    rows_.middleRows(used_, now) = rows.middleRows(done, now);
    used_ += now;
    done += now;
  }
}

void RowFactor::Compress() {
  rows_.bottomRows(rows_.rows() - used_).setZero();
  rows_.topRows(rows_.cols()) = TriangularFactor(rows_);
  used_ = rows_.cols();
}

Eigen::MatrixXd RowFactor::R() {
  Compress();
  return rows_.topRows(rows_.cols());
}

Information Analyse(const Eigen::MatrixXd& r_factor) {
  const Eigen::VectorXd unscale = r_factor.colwise().norm().transpose().unaryExpr(
      [](double n) { return n > 0 ? 1.0 / n : 1.0; });
  SingularValues svd = Decompose(r_factor * unscale.asDiagonal());
  Information information{std::move(svd.singular_values), std::move(svd.v), {}};
  information.directions = unscale.asDiagonal() * information.scaled_directions;
  for (Eigen::Index k = 0; k < information.directions.cols(); ++k) {
    auto direction = information.directions.col(k);
    Eigen::Index largest = 0;
    direction.cwiseAbs().maxCoeff(&largest);
    if (direction[largest] < 0) direction = -direction;  // either sign is the same direction
  }
  return information;
}

InverseInformation Invert(const Information& information, double smallest_ratio) {
  const Eigen::VectorXd& s = information.singular_values;
  InverseInformation result{Eigen::MatrixXd::Zero(s.size(), s.size()), 0};
  while (result.rank < s.size() && s[result.rank] > smallest_ratio * s[0]) {
    const auto direction = information.directions.col(result.rank);
    const double sigma = 1.0 / s[result.rank];
    result.covariance += sigma * direction * (sigma * direction).transpose();
    ++result.rank;
  }
  return result;
}

}  // namespace hexcal
