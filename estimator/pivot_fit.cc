// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/pivot_fit.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>

namespace hexcal {
namespace {

class GaussHelmert {
 public:
  GaussHelmert(const std::vector<PivotPose>& poses,
               const std::vector<Matrix6d>& covariances,
               const std::vector<bool>& used,
               const Eigen::Matrix3Xd& basis,
               const TipAndPivot& start)
      : poses_(poses),
        covariances_(covariances),
        used_(used),
        free_(6, basis.cols() + 3),
        motions_(poses.size(), Vector6d::Zero()) {
    CHECK_EQ(poses.size(), covariances.size());
    CHECK_EQ(poses.size(), used.size());
    free_.setZero();
    free_.topLeftCorner(3, basis.cols()) = basis;
    free_.bottomRightCorner(3, 3).setIdentity();
    fit_.x = start;
    fit_.rows.resize(poses.size());
  }

  PivotFit Run(const PivotFitOptions& options) {
    const double size = Size();
    while (fit_.iterations < options.max_iterations && !fit_.converged) {
      ++fit_.iterations;
      const double step = Step();
      if (!std::isfinite(step)) break;
      fit_.converged = step <= options.tolerance * size;
    }
    Finish();
    return std::move(fit_);
  }

 private:
  // Lengths that a step is small against.
  double Size() const {
    double size = fit_.x.tip_in_tool.norm();
    for (const PivotPose& pose : poses_)
      size = std::max(size, (pose.world_from_tool.translation - fit_.x.pivot_in_world).norm());
    return size;
  }

  // The pose that the motion leads from to the measured one.
  Pose3d Moved(std::size_t i) const {
    const Pose3d& measured = poses_[i].world_from_tool;
    const Vector6d& d = motions_[i];
    Pose3d pose;
    pose.rotation = (measured.rotation * Exp(Eigen::Vector3d(-d.tail<3>()))).normalized();
    pose.translation = measured.translation - pose.rotation * Eigen::Vector3d(d.head<3>());
    return pose;
  }

  void UpdateRow(std::size_t i, const Matrix36d& by_pose) {
    PivotFit::Row& row = fit_.rows[i];
    const Pose3d moved = Moved(i);
    row.error = PivotError(moved, fit_.x) + by_pose * motions_[i];
    row.noise = by_pose * covariances_[i] * by_pose.transpose();
    row.jacobian = PivotParameterJacobian(moved);
  }

  // One step of all; its length, m.
  double Step() {
    const Matrix36d by_pose = PivotPoseJacobian(fit_.x);
    Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(free_.cols(), free_.cols());
    Eigen::VectorXd right = Eigen::VectorXd::Zero(free_.cols());
    for (std::size_t i = 0; i < poses_.size(); ++i) {
      if (!used_[i]) continue;
      UpdateRow(i, by_pose);
      const PivotFit::Row& row = fit_.rows[i];
      const Eigen::MatrixXd jacobian = row.jacobian * free_;
      const Eigen::MatrixXd weighted = jacobian.transpose() * row.noise.inverse();
      normal += weighted * jacobian;
      right -= weighted * row.error;
    }
    const Vector6d step = free_ * normal.ldlt().solve(right);
    double turned = 0.0;
    for (std::size_t i = 0; i < poses_.size(); ++i) {
      if (!used_[i]) continue;
      const PivotFit::Row& row = fit_.rows[i];
      const Vector6d motion = covariances_[i] * by_pose.transpose() *
                              (row.noise.inverse() * (row.error + row.jacobian * step));
      turned = std::max(turned, (by_pose * (motion - motions_[i])).norm());
      motions_[i] = motion;
    }
    fit_.x.tip_in_tool += step.head<3>();
    fit_.x.pivot_in_world += step.tail<3>();
    return std::max(step.norm(), turned);
  }

  void Finish() {
    const Matrix36d by_pose = PivotPoseJacobian(fit_.x);
    Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(free_.cols(), free_.cols());
    int count = 0;
    for (std::size_t i = 0; i < poses_.size(); ++i) {
      UpdateRow(i, by_pose);
      PivotFit::Row& row = fit_.rows[i];
      const Eigen::Matrix3d weight = row.noise.inverse();
      row.squared_sigmas = row.error.dot(weight * row.error);
      if (!used_[i]) continue;
      const Eigen::MatrixXd jacobian = row.jacobian * free_;
      normal += jacobian.transpose() * weight * jacobian;
      fit_.squared_sigmas += row.squared_sigmas;
      ++count;
    }
    const auto p = static_cast<int>(free_.cols());
    fit_.degrees_of_freedom = 3 * count - p;
    const Matrix6d covariance =
        free_ * normal.ldlt().solve(Eigen::MatrixXd::Identity(p, p)) * free_.transpose();
    fit_.covariance = 0.5 * (covariance + covariance.transpose());  // to the last bit
    for (PivotFit::Row& row : fit_.rows)
      row.prediction = row.jacobian * fit_.covariance * row.jacobian.transpose();
  }

  const std::vector<PivotPose>& poses_;
  const std::vector<Matrix6d>& covariances_;
  const std::vector<bool>& used_;
  Eigen::Matrix<double, 6, Eigen::Dynamic>
      free_;                       // of (tip, pivot): the directions that are sought
  std::vector<Vector6d> motions_;  // measured = moved [+] motion
  PivotFit fit_;
};

}  // namespace

Matrix36d PivotPoseJacobian(const TipAndPivot& x) {
  Matrix36d jacobian;
  jacobian << Eigen::Matrix3d::Identity(), -Skew(x.tip_in_tool);
  return jacobian;
}

Matrix36d PivotParameterJacobian(const Pose3d& world_from_tool) {
  Matrix36d jacobian;
  jacobian << Eigen::Matrix3d::Identity(), -world_from_tool.rotation.conjugate().toRotationMatrix();
  return jacobian;
}

PivotFit FitPivot(const std::vector<PivotPose>& poses,
                  const std::vector<Matrix6d>& covariances,
                  const std::vector<bool>& used,
                  const Eigen::Matrix3Xd& basis,
                  const TipAndPivot& start,
                  const PivotFitOptions& options) {
  return GaussHelmert(poses, covariances, used, basis, start).Run(options);
}

}  // namespace hexcal
