// SPDX-License-Identifier: BSD-3-Clause
#include "discovery/design_model.h"

#include <cmath>

namespace hexcal {
namespace {

constexpr double kRidge = 1e-9;

}  // namespace

DesignState::DesignState(const DesignModel& model,
                         const DesignRows& rows,
                         const std::vector<int>& poses)
    : model_(model), rows_(rows) {
  const Eigen::Index unknowns = model.columns.cols();
  // Unknowns are in units in which all rows together say as much of each.
  scale_ = model.columns.colwise().norm();
  for (double& s : scale_) s = s > 0.0 ? 1.0 / s : 1.0;
  Eigen::VectorXd held = Eigen::VectorXd::Constant(unknowns, kRidge);
  if (model.prior.size() > 0) held += model.prior.cwiseProduct(scale_).cwiseProduct(scale_);
  Eigen::MatrixXd information = held.asDiagonal();
  const Eigen::MatrixXd x = RowsOf(rows, model.columns, poses) * scale_.asDiagonal();
  information.noalias() += x.transpose() * x;
  root_.compute(information);
  if (model.signal.size() == 0) {
    value_ = LogDeterminant(model.nuisances);
    return;
  }
  const Eigen::VectorXd s = RowsOf(rows, model.signal, poses);
  explained_ = root_.solve(x.transpose() * s);
  value_ = (s - x * explained_).squaredNorm() + held.dot(explained_.cwiseAbs2());
}

// Of the information on the unknowns from this one on: those before come first in the factor, so
// the rest of its diagonal is that of what is left of the information.
double DesignState::LogDeterminant(Eigen::Index from) const {
  double sum = 0.0;
  for (Eigen::Index k = from; k < scale_.size(); ++k)
    sum += 2.0 * std::log(root_.matrixLLT()(k, k));
  return sum;
}

double DesignState::With(int pose) const {
  const int first = rows_.first[pose], size = rows_.first[pose + 1] - first;
  const Eigen::MatrixXd x = model_.columns.middleRows(first, size) * scale_.asDiagonal();
  const Eigen::MatrixXd z = root_.matrixL().solve(x.transpose());
  Eigen::MatrixXd spread = Eigen::MatrixXd::Identity(size, size);
  if (model_.signal.size() > 0) {
    spread.noalias() += z.transpose() * z;
    const Eigen::VectorXd missed = model_.signal.segment(first, size) - x * explained_;
    return value_ + missed.dot(spread.llt().solve(missed));
  }
  const auto log_determinant = [](const Eigen::MatrixXd& m) {
    const Eigen::MatrixXd root = m.llt().matrixL();
    return 2.0 * root.diagonal().array().log().sum();
  };
  const auto nuisance = z.topRows(model_.nuisances);
  const double without = log_determinant(spread + nuisance.transpose() * nuisance);
  return value_ + log_determinant(spread + z.transpose() * z) - without;
}

}  // namespace hexcal
