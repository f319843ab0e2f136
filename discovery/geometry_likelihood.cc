// SPDX-License-Identifier: BSD-3-Clause
#include "discovery/geometry_likelihood.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "geometry/linear_algebra.h"
#include "model/hexapod.h"

namespace hexcal {
namespace {

constexpr double kRank = 1e-7;
constexpr double kNever = -std::numeric_limits<double>::infinity();

Eigen::MatrixXd Stacked(const Eigen::MatrixXd& upper, const Eigen::MatrixXd& lower) {
  Eigen::MatrixXd all(upper.rows() + lower.rows(), upper.cols());
  all << upper, lower;
  return all;
}

}  // namespace

ReportedGap ReportedGap::Restricted(const LinearProblem& part,
                                    const std::vector<int>& poses) const {
  ReportedGap some = {&part, {}, platform_from_tool, home};
  for (const int pose : poses) some.base_from_platform.push_back(base_from_platform[pose]);
  return some;
}

Eigen::MatrixXd GeometryColumns(const ReportedGap& gap, const HexapodGeometry& hexapod) {
  const Matrix6d in_tool = InverseAdjoint(gap.platform_from_tool);
  const LegLengths home = InverseKinematics(hexapod, gap.home);
  Eigen::MatrixXd columns(6 * gap.base_from_platform.size(), kGeometryErrors);
  for (std::size_t k = 0; k < gap.base_from_platform.size(); ++k) {
    const Pose3d& pose = gap.base_from_platform[k];
    const Matrix6d jacobian = LegJacobian(hexapod, pose);
    const Matrix6d by_length = in_tool * jacobian.partialPivLu().inverse();
    auto rows = columns.middleRows(6 * static_cast<Eigen::Index>(k), 6);
    rows.leftCols<6>() = by_length;
    const LegLengths travel = InverseKinematics(hexapod, pose) - home;
    rows.middleCols<6>(6) = by_length * (travel / home.mean()).asDiagonal();
    for (int leg = 0; leg < kNumLegs; ++leg) {
      // A base joint that moves along the leg takes the platform with it, a platform joint that
      // does so leaves less of the leg.
      const Eigen::RowVector3d u_in_platform = jacobian.block<1, 3>(leg, 0);
      const Eigen::RowVector3d u_in_base = (pose.rotation * u_in_platform.transpose()).transpose();
      rows.middleCols<3>(12 + 3 * leg) = by_length.col(leg) * u_in_base;
      rows.middleCols<3>(30 + 3 * leg) = -by_length.col(leg) * u_in_platform;
    }
  }
  return columns;
}

GeometryLikelihood::GeometryLikelihood(const ReportedGap& gap, const GapNoise& noise)
    : gap_(gap), noise_(noise) {
  const LinearProblem& problem = *gap.problem;
  nuisance_ = WhitenPoseRows(problem, noise, problem.nuisance);
  error_ = WhitenPoseRows(problem, noise, problem.error);
  const Eigen::MatrixXd basis = OrthonormalBasis(
      Stacked(nuisance_, WhitenShapeRows(problem, noise, problem.shape_nuisance)), kRank);
  const Eigen::VectorXd error =
      Stacked(error_, WhitenShapeRows(problem, noise, problem.shape_error));
  basis_ = basis.topRows(error_.size());
  residual_ = error_ - basis_ * (basis.transpose() * error);
}

// Errors move no shape rows, so those count in the projection alone.
GeometryLikelihood::Normal GeometryLikelihood::NormalOf(const HexapodGeometry& hexapod) const {
  Normal normal;
  normal.columns = WhitenPoseRows(*gap_.problem, noise_, GeometryColumns(gap_, hexapod));
  normal.square.setZero(kGeometryErrors, kGeometryErrors);
  auto lower = normal.square.selfadjointView<Eigen::Lower>();
  lower.rankUpdate(normal.columns.transpose());
  lower.rankUpdate((basis_.transpose() * normal.columns).transpose(), -1.0);
  normal.product = normal.columns.transpose() * residual_;
  return normal;
}

double GeometryLikelihood::LogGain(const HexapodGeometry& hexapod, double width) const {
  const Normal normal = NormalOf(hexapod);
  if (!normal.product.allFinite()) return kNever;
  Eigen::MatrixXd posterior = width * width * normal.square;
  posterior.diagonal().array() += 1.0;
  const Eigen::LLT<Eigen::MatrixXd, Eigen::Lower> factor(posterior);
  if (factor.info() != Eigen::Success) return kNever;
  const Eigen::VectorXd half = factor.matrixL().solve(width * normal.product);
  const double volume = factor.matrixLLT().diagonal().array().log().sum();
  const double gain = 0.5 * half.squaredNorm() - volume;
  return std::isfinite(gain) ? gain : kNever;
}

GeometryLikelihood::Fit GeometryLikelihood::Solve(const HexapodGeometry& hexapod,
                                                  double width) const {
  const Normal normal = NormalOf(hexapod);
  const Eigen::MatrixXd square = normal.square.selfadjointView<Eigen::Lower>();
  Eigen::MatrixXd posterior = square;
  posterior.diagonal().array() += 1.0 / (width * width);
  const Eigen::LDLT<Eigen::MatrixXd> factor(posterior);
  Fit fit;
  fit.errors = factor.solve(normal.product);
  fit.freedom = factor.solve(square).trace();
  const Eigen::VectorXd rest = error_ - normal.columns * fit.errors;
  const LinearProblem& problem = *gap_.problem;
  fit.nuisances =
      ShortestSolution(Stacked(nuisance_, WhitenShapeRows(problem, noise_, problem.shape_nuisance)),
                       Stacked(rest, WhitenShapeRows(problem, noise_, problem.shape_error)),
                       kRank * kRank);
  fit.chi_square = (rest - nuisance_ * fit.nuisances).squaredNorm();
  return fit;
}

}  // namespace hexcal
