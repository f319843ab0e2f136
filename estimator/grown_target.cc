// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/grown_target.h"

#include <glog/logging.h>

#include <cmath>
#include <utility>
#include <vector>

#include "estimator/normal_matrix.h"

namespace hexcal {
namespace {

Pose3d Moved(const Pose3d& x, const Vector6d& twist) {
  return twist.isZero(0.0) ? x : Plus(x, twist);
}

// Of the parameters, 1 / sigma^2; zero where there is none.
Eigen::VectorXd InformationOfPriors(const GrownSolution& solution) {
  Eigen::VectorXd information = Eigen::VectorXd::Zero(solution.fit.covariance.rows());
  Eigen::Index at = 12;
  for (const GrownEffect& effect : solution.effects)
    for (const double sigma : effect.prior_sigma) {
      if (std::isfinite(sigma)) information[at] = 1.0 / (sigma * sigma);
      ++at;
    }
  return information;
}

Matrix12d OfKnownEffects(const GrownSolution& solution) {
  const auto evaluation = solution.Problem().Evaluate(solution.fit.mounts, solution.fit.free, true);
  CHECK(evaluation) << "a solution that cannot be evaluated";
  const Eigen::MatrixXd by_mounts = evaluation->jacobian.leftCols<12>();
  Matrix12d covariance =
      std::pow(solution.noise_scale, 2) * InverseOfNormal(by_mounts.transpose() * by_mounts);
  covariance.topLeftCorner<6, 6>() += solution.common;
  return covariance;
}

}  // namespace

GrownTarget::GrownTarget(std::shared_ptr<const GrownSolution> solution)
    : solution_(std::move(solution)),
      places_(*solution_->dataset, hexapod(), solution_->home),
      covariance_(solution_->Covariance()),
      of_known_effects_(OfKnownEffects(*solution_)) {
  const Eigen::MatrixXd& of_fit = solution_->fit.covariance;
  by_priors_ = std::pow(solution_->noise_scale, 2) * of_fit *
               InformationOfPriors(*solution_).asDiagonal() * of_fit;
  if (!solution_->is_noise_estimated) return;
  levels_ = LevelsOf(*solution_);
  covariance_ = levels_->covariance;
  covariance_.topLeftCorner<6, 6>() += solution_->common;
}

std::optional<double> GrownTarget::FreedomOf(const Eigen::MatrixXd& j) const {
  if (!levels_) return std::nullopt;
  return levels_->FreedomOf(j);
}

Visit GrownTarget::VisitAt(const Pose3d& base_from_platform, int row) const {
  return row == kNoRow ? places_.At(base_from_platform) : solution_->visits[row];
}

Mounts GrownTarget::MountsAt(const Eigen::VectorXd& step) const {
  const Mounts& mounts = solution_->fit.mounts;
  return {Moved(mounts.world_from_base, step.head<6>()),
          Moved(mounts.platform_from_tool, step.segment<6>(6))};
}

std::optional<GrownTarget::Chain> GrownTarget::ChainAt(const Pose3d& base_from_platform,
                                                       int row,
                                                       const Eigen::VectorXd& step) const {
  CHECK_EQ(step.size(), size());
  const Visit visit = VisitAt(base_from_platform, row);
  std::vector<Effect> effects = solution_->fit.effects;
  Eigen::Index at = 12;
  for (std::size_t e = 0; e < effects.size(); ++e)
    for (const int number : solution_->effects[e].free) effects[e].parameters[number] += step[at++];
  const Corrections<double> corrections = CorrectionsOf(effects, solution_->data.pose_map, visit);
  const Mounts mounts = MountsAt(step);
  const ForwardPose pose = Forward(mounts, hexapod(), visit, corrections);
  if (!pose.reached) return std::nullopt;
  return Chain{{Moved(mounts.world_from_base, corrections.base_twist),
                Moved(mounts.platform_from_tool, corrections.tool_twist)},
               pose.base_from_platform};
}

std::optional<GrownTarget::Uncertain> GrownTarget::At(const Pose3d& base_from_platform,
                                                      int row) const {
  const Visit visit = VisitAt(base_from_platform, row);
  const std::vector<Effect>& effects = solution_->fit.effects;
  const Mounts& mounts = solution_->fit.mounts;
  const Corrections<double> corrections = CorrectionsOf(effects, solution_->data.pose_map, visit);
  const ForwardPose pose = Forward(mounts, hexapod(), visit, corrections);
  if (!pose.reached) return std::nullopt;
  Uncertain at;
  at.chain = {{Moved(mounts.world_from_base, corrections.base_twist),
               Moved(mounts.platform_from_tool, corrections.tool_twist)},
              pose.base_from_platform};
  at.by_parameters.resize(6, size());
  at.by_parameters.leftCols<12>() = ForwardByMounts(mounts, corrections, pose);
  Eigen::Index column = 12;
  for (std::size_t e = 0; e < effects.size(); ++e)
    for (const int number : solution_->effects[e].free)
      at.by_parameters.col(column++) = ForwardDerivative(
          mounts, hexapod(), visit, corrections, pose, CorrectionsBy(effects[e], number, visit));
  return at;
}

GrownTarget GrownTarget::OfKnownNoise() const {
  GrownTarget known = *this;
  known.covariance_ = solution_->CovarianceUnscaled();
  known.levels_.reset();
  const double unscale = 1.0 / std::pow(solution_->noise_scale, 2);
  known.by_priors_ *= unscale;
  known.of_known_effects_.topLeftCorner<6, 6>() -= solution_->common;
  known.of_known_effects_ *= unscale;
  known.of_known_effects_.topLeftCorner<6, 6>() += solution_->common;
  return known;
}

}  // namespace hexcal
