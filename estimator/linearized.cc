// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/linearized.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "config/units.h"
#include "estimator/rms.h"
#include "geometry/align_points.h"
#include "geometry/linear_algebra.h"
#include "geometry/rotation_angles.h"

namespace hexcal {
namespace {

using Error = LinearizedOptions::Error;
using UnitMagnitude = LinearizedOptions::UnitMagnitude;

// Updates as small as this many roundings of the data never get smaller.
constexpr double kRoundings = 64.0;

// Columns of a rotation, the first two axes of order kept as far as may be.
Eigen::Matrix3d Orthogonalise(const Eigen::Matrix3d& m, int first, int second) {
  Eigen::Matrix3d r;
  r.col(first) = m.col(first).normalized();
  r.col(second) = (m.col(second) - r.col(first) * r.col(first).dot(m.col(second))).normalized();
  const int third = 3 - first - second;
  r.col(third) = r.col((third + 1) % 3).cross(r.col((third + 2) % 3));
  return r;
}

Eigen::Matrix3d MakeUnitMagnitude(const Eigen::Matrix3d& m, UnitMagnitude reading) {
  switch (reading) {
    case UnitMagnitude::kApproachFirst:
      return Orthogonalise(m, 2, 1);
    case UnitMagnitude::kNormalFirst:
      return Orthogonalise(m, 0, 1);
    case UnitMagnitude::kNearestRotation:
      return NearestRotation(m);
    case UnitMagnitude::kColumns:
      return m.colwise().normalized();
    case UnitMagnitude::kRows:
      return m.rowwise().normalized();
  }
  return m;
}

// A homogeneous transform whose rotation need not be orthonormal: what the paper's update makes.
struct Transform {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();

  explicit Transform(const Pose3d& pose)
      : rotation(pose.rotation.toRotationMatrix()), translation(pose.translation) {}
  Transform(const Eigen::Matrix3d& r, const Eigen::Vector3d& t) : rotation(r), translation(t) {}
  Transform operator*(const Transform& b) const {
    return {rotation * b.rotation, rotation * b.translation + translation};
  }
  Pose3d ToPose() const { return MakePose(NearestRotation(rotation), translation); }
};

// Eqs. (44), (45): T (1 + delta T), then unit magnitude.
Transform PaperUpdate(const Transform& t, const Vector6d& y, UnitMagnitude reading) {
  const Eigen::Vector3d turn = y.tail<3>();
  return {MakeUnitMagnitude(t.rotation + t.rotation * Skew(turn), reading),
          t.rotation * y.head<3>() + t.translation};
}

double WrapAngle(double a) { return std::remainder(a, 2.0 * kPi); }

// Eqs. (22) and (43): p_m - p_c.
Vector6d PaperError(const Pose3d& measured, const Transform& predicted) {
  Vector6d x;
  x.head<3>() = measured.translation - predicted.translation;
  x.tail<3>() = (AnglesFromRotation(measured.rotation.toRotationMatrix()) -
                 AnglesFromRotation(predicted.rotation))
                    .unaryExpr(&WrapAngle);
  return x;
}

// Eqs. (16)-(20) with U = base_from_tool, as the paper has them for any U.
Matrix6x12d JacobianOf(const Transform& u) {
  Matrix6x12d j = Matrix6x12d::Zero();
  const Eigen::Matrix3d r = u.rotation.transpose();
  j.block<3, 3>(0, 0) = r;
  j.block<3, 3>(0, 3) = -r * Skew(u.translation);
  j.block<3, 3>(3, 3) = r;
  j.block<6, 6>(0, 6).setIdentity();
  return j;
}

class Iteration {
 public:
  Iteration(const std::vector<Observation>& observations,
            const std::vector<Matrix6d>& weights,
            const BaseAndTool& start,
            const LinearizedOptions& options)
      : observations_(observations),
        weights_(weights),
        options_(options),
        tolerance_(std::max(options.tolerance, kRoundings * Rounding(observations).position)),
        base_(start.world_from_base),
        tool_(start.platform_from_tool) {}

  Solution Run() {
    Solution solution;
    solution.iterations.push_back(BuildEquations());
    double update = 0.0;
    for (int k = 0; k < options_.max_iterations && !solution.converged; ++k) {
      const Vector12d y = SolveEquations();
      const Transform base = base_, tool = tool_;
      Update(y);
      const IterationRecord record = BuildEquations();
      if (!y.allFinite() || !std::isfinite(record.cost)) {
        base_ = base, tool_ = tool;
        solution.message = fmt::format("the iteration left the range of numbers at step {}", k + 1);
        break;
      }
      solution.iterations.push_back(record);
      update = y.cwiseAbs().maxCoeff();
      solution.converged = update <= tolerance_;
    }
    if (!solution.converged && solution.message.empty())
      solution.message = fmt::format(
          "the last of {} updates was still {:.3g} (m or rad), above the tolerance {:.3g}",
          options_.max_iterations,
          update,
          tolerance_);
    solution.mounts = {base_.ToPose(), tool_.ToPose()};
    return solution;
  }

 private:
  // Stacks x(k) and J(k) at the present mounts.
  IterationRecord BuildEquations() {
    const auto n = static_cast<Eigen::Index>(observations_.size());
    x_.resize(6 * n);
    j_.resize(6 * n, 12);
    RmsError rms;
    for (Eigen::Index i = 0; i < n; ++i) {
      const Observation& o = observations_[i];
      const Transform u = Transform(o.base_from_platform) * tool_;
      const Vector6d x = ErrorOf(o, u);
      rms.Add(x);
      x_.segment<6>(6 * i) = weights_.empty() ? x : Vector6d(weights_[i] * x);
      j_.middleRows<6>(6 * i) =
          weights_.empty() ? JacobianOf(u) : Matrix6x12d(weights_[i] * JacobianOf(u));
    }
    return {0.5 * x_.squaredNorm(), rms.Position(), rms.Orientation()};
  }

  Vector6d ErrorOf(const Observation& o, const Transform& u) const {
    const Transform predicted = base_ * u;
    if (options_.error == Error::kPaper) return PaperError(o.world_from_tool, predicted);
    return Minus(o.world_from_tool, MakePose(predicted.rotation, predicted.translation));
  }

  // Shortest least-squares solution with the columns scaled; a direction that the data do not
  // determine is left alone.
  Vector12d SolveEquations() const {
    const Vector12d scale = j_.colwise().norm().transpose().cwiseInverse();
    Eigen::MatrixXd equations(j_.rows(), 13);
    equations << j_ * scale.asDiagonal(), x_;
    const Eigen::MatrixXd r = TriangularFactor(equations);
    return scale.asDiagonal() * ShortestSolution(r.topLeftCorner(12, 12),
                                                 r.topRightCorner(12, 1),
                                                 CovarianceOptions().smallest_ratio);
  }

  void Update(const Vector12d& y) {
    const Vector6d base_step = y.head<6>(), tool_step = y.tail<6>();
    if (options_.error == Error::kPaper) {
      base_ = PaperUpdate(base_, base_step, options_.unit_magnitude);
      tool_ = PaperUpdate(tool_, tool_step, options_.unit_magnitude);
    } else {
      base_ = Transform(Plus(base_.ToPose(), base_step));
      tool_ = Transform(Plus(tool_.ToPose(), tool_step));
    }
  }

  const std::vector<Observation>& observations_;
  const std::vector<Matrix6d>& weights_;
  const LinearizedOptions& options_;
  double tolerance_;
  Transform base_, tool_;
  Eigen::VectorXd x_;
  Eigen::MatrixXd j_;
};

}  // namespace

Matrix6d PaperErrorDerivative(const Pose3d& predicted_world_from_tool) {
  const Eigen::Matrix3d rotation = predicted_world_from_tool.rotation.toRotationMatrix();
  Matrix6d derivative = Matrix6d::Zero();
  derivative.topLeftCorner<3, 3>() = rotation;
  derivative.bottomRightCorner<3, 3>() = AnglesByTurn(AnglesFromRotation(rotation));
  return derivative;
}

Solution SolveLinearized(const std::vector<Observation>& observations,
                         const std::vector<Matrix6d>& weights,
                         const BaseAndTool& start,
                         const LinearizedOptions& options) {
  return Iteration(observations, weights, start, options).Run();
}

}  // namespace hexcal
