// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/target_error.h"

#include <algorithm>
#include <cmath>

#include "estimator/error_length.h"
#include "estimator/quantiles.h"

namespace hexcal {
namespace {

using Matrix36d = Eigen::Matrix<double, 3, 6>;

constexpr double kUpper = 0.975;  // of Intervals' half widths
// Beyond this t is the normal distribution to all digits that matter.
constexpr double kMany = 1e7;

Eigen::Matrix3d ShareOf(const Matrix36d& jacobian, const ErrorSource& source) {
  if (source.covariance_in_tool) {
    const Eigen::Matrix3d turn = jacobian.leftCols<3>();
    return turn * *source.covariance_in_tool * turn.transpose();
  }
  Vector6d variance;
  variance << Eigen::Vector3d::Constant(source.position * source.position),
      Eigen::Vector3d::Constant(source.orientation * source.orientation);
  return jacobian * variance.asDiagonal() * jacobian.transpose();
}

}  // namespace

double TargetCovariance::Rms() const { return std::sqrt(total.trace()); }

double TargetCovariance::Quantile(double probability) const {
  return LengthQuantile(total, probability, degrees_of_freedom);
}

double LeastDegreesOfFreedom(const Estimate& estimate) {
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 12; ++i)
    // NaN where nothing is left over that could tell.
    if (estimate.observability.determined[i] && estimate.intervals.degrees_of_freedom[i] > 0.0)
      least = std::min(least, estimate.intervals.degrees_of_freedom[i]);
  return least;
}

Matrix12d CoverageCovariance(const Estimate& estimate) {
  Vector12d widening = Vector12d::Ones();
  for (int i = 0; i < 12; ++i) {
    const double sigma = std::sqrt(estimate.covariance(i, i));
    const double half_width = estimate.intervals.half_width[i];
    const double dof = estimate.intervals.degrees_of_freedom[i];
    // Exact data have no intervals to speak of.
    if (estimate.observability.determined[i] && sigma > 0.0 && dof > 0.0 &&
        std::isfinite(half_width))
      widening[i] = half_width / (StudentTQuantile(kUpper, std::min(dof, kMany)) * sigma);
  }
  return widening.asDiagonal() * estimate.covariance * widening.asDiagonal();
}

Matrix36d PointJacobian(const Pose3d& a_from_b, const Eigen::Vector3d& p_in_b) {
  const Eigen::Matrix3d rotation = a_from_b.rotation.toRotationMatrix();
  Matrix36d jacobian;
  jacobian << rotation, -rotation * Skew(p_in_b);
  return jacobian;
}

Eigen::Matrix<double, 3, 12> TargetJacobian(const BaseAndTool& mounts,
                                            const Pose3d& base_from_platform,
                                            const Eigen::Vector3d& p_in_tool) {
  const Pose3d base_from_tool = base_from_platform * mounts.platform_from_tool;
  return PointJacobian(mounts.world_from_base * base_from_tool, p_in_tool) *
         PaperJacobian(base_from_tool);
}

TargetError::TargetError(const Estimate& estimate,
                         std::vector<ErrorSource> sources,
                         std::shared_ptr<const GrownTarget> grown)
    : mounts_(estimate.mounts),
      covariance_(CoverageCovariance(estimate)),
      degrees_of_freedom_(LeastDegreesOfFreedom(estimate)),
      sources_(std::move(sources)),
      grown_(std::move(grown)) {}

GrownTarget::Chain TargetError::Calibration(const Pose3d& base_from_platform,
                                            const Eigen::Vector3d& p_in_tool,
                                            int row,
                                            TargetCovariance* target,
                                            double* degrees_of_freedom) const {
  if (!grown_) {
    const Eigen::Matrix<double, 3, 12> j = TargetJacobian(mounts_, base_from_platform, p_in_tool);
    target->calibration = j * covariance_ * j.transpose();
    return {mounts_, base_from_platform};
  }
  const auto at = grown_->At(base_from_platform, row);
  if (!at) {
    target->calibration.setConstant(std::numeric_limits<double>::quiet_NaN());
    return {mounts_, base_from_platform};
  }
  const Eigen::MatrixXd j = PointJacobian(at->chain.WorldFromTool(), p_in_tool) * at->by_parameters;
  const Eigen::MatrixXd by_mounts = j.leftCols<12>();
  target->calibration = j * grown_->covariance() * j.transpose();
  *degrees_of_freedom = grown_->FreedomOf(j).value_or(degrees_of_freedom_);
  target->of_effects = target->calibration -
                       by_mounts * grown_->covariance_of_known_effects() * by_mounts.transpose();
  target->by_priors = j * grown_->covariance_by_priors() * j.transpose();
  return at->chain;
}

std::optional<TargetError::Carried> TargetError::CarriedTo(const Pose3d& base_from_platform,
                                                           const Eigen::Vector3d& p_in_tool) const {
  if (!grown_) return Carried{TargetJacobian(mounts_, base_from_platform, p_in_tool), covariance_};
  const auto at = grown_->At(base_from_platform, GrownTarget::kNoRow);
  if (!at) return std::nullopt;
  return Carried{PointJacobian(at->chain.WorldFromTool(), p_in_tool) * at->by_parameters,
                 grown_->covariance()};
}

TargetCovariance TargetError::At(const Pose3d& base_from_platform,
                                 const Eigen::Vector3d& p_in_tool,
                                 int row) const {
  TargetCovariance target;
  double freedom = degrees_of_freedom_;
  const GrownTarget::Chain chain =
      Calibration(base_from_platform, p_in_tool, row, &target, &freedom);
  const Pose3d world_from_platform = chain.WorldFromPlatform();
  const Pose3d world_from_tool = chain.WorldFromTool();
  target.p_in_world = world_from_tool * p_in_tool;
  target.total = target.calibration;
  double per_freedom = std::pow(target.calibration.trace(), 2) / freedom;
  for (const ErrorSource& source : sources_) {
    Matrix36d carry = Matrix36d::Zero();
    switch (source.site) {
      case SourceSite::kPlatform:
        carry = PointJacobian(world_from_platform, chain.mounts.platform_from_tool * p_in_tool);
        break;
      case SourceSite::kTool:
        carry = PointJacobian(world_from_tool, p_in_tool);
        break;
      case SourceSite::kWorld:
        carry = PointJacobian(Pose3d{}, target.p_in_world);
        break;
      case SourceSite::kPoint:
        carry.leftCols<3>().setIdentity();
        break;
      case SourceSite::kPointInTool:
        carry.leftCols<3>() = world_from_tool.rotation.toRotationMatrix();
        break;
    }
    target.shares.push_back(ShareOf(carry, source));
    target.sensitivities.emplace_back(carry.leftCols<3>().norm(), carry.rightCols<3>().norm());
    target.total += target.shares.back();
    per_freedom += std::pow(target.shares.back().trace(), 2) / source.degrees_of_freedom;
  }
  const double of_sum = std::pow(target.total.trace(), 2) / per_freedom;
  target.degrees_of_freedom =
      per_freedom > 0.0 && of_sum < kMany ? of_sum : std::numeric_limits<double>::infinity();
  return target;
}

}  // namespace hexcal
