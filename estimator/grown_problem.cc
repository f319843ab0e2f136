// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/grown_problem.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace hexcal {
namespace {

// Central differences for what goes through rigid fits: of the plausible size of a parameter, at
// which the fits are as good as linear.
constexpr double kStep = 0.1;
constexpr double kSmallestStep = 1e-6;

bool IsOfTrackerOrMarkers(const Effect& effect) {
  const EffectKind* kind = FindEffectKind(effect.name);
  return kind != nullptr && (kind->site == "tracker" || kind->site == "marker");
}

double StepFor(const Effect& effect, int number) {
  const double scale = FindEffectKind(effect.name)->ScaleOf(number);
  return std::max(kStep * scale, kSmallestStep * std::abs(effect.parameters[number]));
}

// d(measured [-] predicted) / d(right twist of predicted).
Matrix6d ErrorByPredicted(const Vector6d& error) {
  Matrix6d by = -Matrix6d::Identity();
  by.topRightCorner<3, 3>() = Skew(Eigen::Vector3d(error.head<3>()));
  by.bottomRightCorner<3, 3>() = -LeftJacobianInverse(error.tail<3>());
  return by;
}

std::vector<int> RowsOf(const std::vector<GrownPose>& poses) {
  std::vector<int> rows;
  for (const GrownPose& pose : poses) rows.push_back(pose.row);
  return rows;
}

bool HasPrior(const GrownEffect& effect, std::size_t k) {
  return std::isfinite(effect.prior_sigma[static_cast<Eigen::Index>(k)]);
}

}  // namespace

Corrections<double> CorrectionsOf(const std::vector<Effect>& effects,
                                  const std::optional<PoseMap>& pose_map,
                                  const Visit& visit) {
  Corrections<double> corrections = CorrectionsOf(effects, visit);
  if (pose_map) corrections.platform_twist += PoseMapTwist(*pose_map, visit.base_from_platform);
  return corrections;
}

GrownProblem::GrownProblem(Data data, std::vector<GrownEffect> effects)
    : data_(std::move(data)),
      effects_(std::move(effects)),
      sight_(*data_.dataset, RowsOf(data_.poses)) {
  int priors = 0;
  for (const GrownEffect& effect : effects_) {
    CHECK_EQ(effect.prior_mean.size(), static_cast<Eigen::Index>(effect.free.size()));
    CHECK_EQ(effect.prior_sigma.size(), static_cast<Eigen::Index>(effect.free.size()));
    num_free_ += static_cast<int>(effect.free.size());
    for (std::size_t k = 0; k < effect.free.size(); ++k) priors += HasPrior(effect, k) ? 1 : 0;
    sees_truly_ = sees_truly_ && !IsOfTrackerOrMarkers(effect.effect);
  }
  if (data_.with_misfit) num_misfit_ = sight_.misfit_rows();
  if (data_.with_misfit) misfit_freedom_ = sight_.misfit_freedom();
  num_rows_ = 6 * static_cast<int>(data_.poses.size()) + num_misfit_ + priors;
}

Eigen::VectorXd GrownProblem::Start() const {
  Eigen::VectorXd free(num_free_);
  int at = 0;
  for (const GrownEffect& effect : effects_)
    for (const int number : effect.free) free[at++] = effect.effect.parameters[number];
  return free;
}

std::vector<Effect> GrownProblem::EffectsAt(const Eigen::VectorXd& free) const {
  CHECK_EQ(free.size(), num_free_);
  std::vector<Effect> effects;
  int at = 0;
  for (const GrownEffect& effect : effects_) {
    effects.push_back(effect.effect);
    for (const int number : effect.free) effects.back().parameters[number] = free[at++];
  }
  return effects;
}

std::vector<std::pair<int, int>> GrownProblem::FreeNumbers() const {
  std::vector<std::pair<int, int>> numbers;
  for (std::size_t e = 0; e < effects_.size(); ++e)
    for (const int number : effects_[e].free) numbers.emplace_back(static_cast<int>(e), number);
  return numbers;
}

std::vector<Corrections<double>> GrownProblem::CorrectionsAt(
    const std::vector<Effect>& effects) const {
  std::vector<Corrections<double>> corrections;
  corrections.reserve(data_.visits->size());
  for (const Visit& visit : *data_.visits)
    corrections.push_back(CorrectionsOf(effects, data_.pose_map, visit));
  return corrections;
}

Sight GrownProblem::SightAt(const std::vector<Corrections<double>>& corrections) const {
  if (!sees_truly_ || data_.with_misfit) {
    Sight sight = sight_.See(corrections);
    // Corrections that are none leave the poses as they are given.
    if (sees_truly_)
      for (std::size_t i = 0; i < data_.poses.size(); ++i)
        sight.world_from_tool[i] = data_.poses[i].world_from_tool;
    return sight;
  }
  Sight sight;
  for (const GrownPose& pose : data_.poses) sight.world_from_tool.push_back(pose.world_from_tool);
  return sight;
}

void GrownProblem::AddMisfit(const Eigen::VectorXd& misfit,
                             Eigen::Ref<Eigen::VectorXd> rows) const {
  if (num_misfit_ > 0)
    rows.segment(6 * static_cast<Eigen::Index>(data_.poses.size()), num_misfit_) =
        misfit / data_.misfit_scale;
}

void GrownProblem::AddPriors(const Eigen::VectorXd& free, Evaluation* evaluation) const {
  Eigen::Index row = 6 * static_cast<Eigen::Index>(data_.poses.size()) + num_misfit_, at = 0;
  for (const GrownEffect& effect : effects_)
    for (std::size_t k = 0; k < effect.free.size(); ++k, ++at) {
      if (!HasPrior(effect, k)) continue;
      const auto i = static_cast<Eigen::Index>(k);
      evaluation->residual[row] = (free[at] - effect.prior_mean[i]) / effect.prior_sigma[i];
      if (evaluation->jacobian.size() > 0)
        evaluation->jacobian(row, 12 + at) = 1.0 / effect.prior_sigma[i];
      ++row;
    }
}

void GrownProblem::AddForward(const Mounts& mounts,
                              const std::vector<Effect>& effects,
                              const std::vector<Corrections<double>>& corrections,
                              const std::vector<ForwardPose>& poses,
                              Evaluation* evaluation) const {
  const std::vector<std::pair<int, int>> numbers = FreeNumbers();
  for (std::size_t i = 0; i < data_.poses.size(); ++i) {
    const GrownPose& pose = data_.poses[i];
    const Visit& visit = (*data_.visits)[pose.row];
    const Corrections<double>& here = corrections[pose.row];
    const Matrix6d by_predicted = pose.whitener * ErrorByPredicted(evaluation->errors[i]);
    auto rows = evaluation->jacobian.middleRows<6>(6 * static_cast<Eigen::Index>(i));
    rows.leftCols<12>() = by_predicted * ForwardByMounts(mounts, here, poses[i]);
    for (std::size_t k = 0; k < numbers.size(); ++k)
      rows.col(12 + static_cast<Eigen::Index>(k)) =
          by_predicted *
          ForwardDerivative(mounts,
                            data_.hexapod,
                            visit,
                            here,
                            poses[i],
                            CorrectionsBy(effects[numbers[k].first], numbers[k].second, visit));
  }
}

void GrownProblem::AddSight(const Eigen::VectorXd& free, Evaluation* evaluation) const {
  const std::vector<std::pair<int, int>> numbers = FreeNumbers();
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    const Effect& effect = effects_[numbers[k].first].effect;
    if (!IsOfTrackerOrMarkers(effect)) continue;
    const auto column = 12 + static_cast<Eigen::Index>(k);
    const double step = StepFor(effect, numbers[k].second);
    for (const double side : {-1.0, 1.0}) {
      Eigen::VectorXd moved = free;
      moved[static_cast<Eigen::Index>(k)] += side * step;
      const Sight sight = SightAt(CorrectionsAt(EffectsAt(moved)));
      Eigen::VectorXd rows = Eigen::VectorXd::Zero(num_rows_);
      for (std::size_t i = 0; i < data_.poses.size(); ++i)
        rows.segment<6>(6 * static_cast<Eigen::Index>(i)) =
            data_.poses[i].whitener * Minus(sight.world_from_tool[i], evaluation->predicted[i]);
      AddMisfit(sight.misfit, rows);
      evaluation->jacobian.col(column) += side / (2.0 * step) * rows;
    }
  }
}

std::optional<GrownProblem::Evaluation> GrownProblem::Evaluate(const Mounts& mounts,
                                                               const Eigen::VectorXd& free,
                                                               bool with_jacobian) const {
  const std::vector<Effect> effects = EffectsAt(free);
  const std::vector<Corrections<double>> corrections = CorrectionsAt(effects);
  Sight sight = SightAt(corrections);
  Evaluation evaluation;
  evaluation.residual.setZero(num_rows_);
  std::vector<ForwardPose> poses;
  for (std::size_t i = 0; i < data_.poses.size(); ++i) {
    const GrownPose& pose = data_.poses[i];
    poses.push_back(
        Forward(mounts, data_.hexapod, (*data_.visits)[pose.row], corrections[pose.row]));
    if (!poses.back().reached) return std::nullopt;
    evaluation.predicted.push_back(poses.back().world_from_tool);
    evaluation.errors.push_back(Minus(sight.world_from_tool[i], poses.back().world_from_tool));
    evaluation.residual.segment<6>(6 * static_cast<Eigen::Index>(i)) =
        pose.whitener * evaluation.errors.back();
  }
  AddMisfit(sight.misfit, evaluation.residual);
  if (with_jacobian) {
    evaluation.jacobian.setZero(num_rows_, 12 + num_free_);
    AddForward(mounts, effects, corrections, poses, &evaluation);
    AddSight(free, &evaluation);
  }
  AddPriors(free, &evaluation);
  evaluation.seen = std::move(sight.world_from_tool);
  if (!evaluation.residual.allFinite() || !evaluation.jacobian.allFinite()) return std::nullopt;
  return evaluation;
}

}  // namespace hexcal
