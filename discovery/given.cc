// SPDX-License-Identifier: BSD-3-Clause
#include "discovery/given.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "estimator/quantiles.h"
#include "geometry/linear_algebra.h"
#include "model/data_fault.h"
#include "model/machine_rows.h"
#include "model/predict.h"

namespace hexcal {
namespace {

constexpr double kWide = 30.0;  // priors that hold gauges only, in plausible sizes
constexpr int kRounds = 2;      // of noise and fit
constexpr double kRank = 1e-9;

bool IsFault(const Effect& effect) {
  const EffectKind* kind = FindEffectKind(effect.name);
  return kind != nullptr && kind->IsFault();
}

std::vector<int> AllForms(const FormLibrary& library) {
  std::vector<int> all(library.forms.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

// Chi-square of d with its covariance, in the directions that this has.
double SurvivalOf(const Eigen::VectorXd& d, const Eigen::MatrixXd& covariance) {
  if (d.size() == 0) return 1.0;
  const Eigen::VectorXd sigma = covariance.diagonal().cwiseSqrt();
  if (!(sigma.minCoeff() > 0.0)) return 1.0;
  const Eigen::VectorXd inverse = sigma.cwiseInverse();
  const Eigenvalues eigen =
      DecomposeSymmetric(inverse.asDiagonal() * covariance * inverse.asDiagonal());
  const Eigen::VectorXd along = eigen.vectors.transpose() * d.cwiseProduct(inverse);
  double squared = 0.0;
  int rank = 0;
  for (Eigen::Index k = 0; k < along.size(); ++k) {
    if (eigen.values[k] < kRank * eigen.values.maxCoeff()) continue;
    squared += along[k] * along[k] / eigen.values[k];
    ++rank;
  }
  return ChiSquareTail(squared, rank);
}

// The effect is nothing where these are zero: not periods, times, phases, masses.
bool ActsAlone(const EffectKind* kind, int number) {
  if (kind == nullptr) return true;
  const ParameterKind& parameter = kind->ParameterOf(number);
  return parameter.acts_alone && !parameter.is_search;
}

bool IsPhase(const EffectKind* kind, int number) {
  return kind != nullptr && kind->UnitOf(number) == "rad" && !kind->ParameterOf(number).acts_alone;
}

GivenJudgement JudgeOne(const Effect& now,
                        const Effect& before,
                        const FormDefinition& form,
                        const Eigen::MatrixXd& covariance,
                        double alpha) {
  const EffectKind* kind = FindEffectKind(now.name);
  std::vector<int> acting;
  Eigen::VectorXd moved(form.size());
  Eigen::MatrixXd of_move = covariance;
  for (int k = 0; k < form.size(); ++k) {
    Eigen::Index number = 0;
    form.directions.col(k).maxCoeff(&number);
    const int n = static_cast<int>(number);
    if (ActsAlone(kind, n)) acting.push_back(k);
    moved[k] = now.parameters[n] - before.parameters[n];
    if (IsPhase(kind, n)) moved[k] = std::remainder(moved[k], 2.0 * M_PI);
    if (before.standard_deviation.size() > n && std::isfinite(before.standard_deviation[n]))
      of_move(k, k) += std::pow(before.standard_deviation[n], 2);
  }
  const auto count = static_cast<Eigen::Index>(acting.size());
  Eigen::VectorXd value(count);
  Eigen::MatrixXd of_value(count, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    value[i] = form.directions.col(acting[i]).dot(now.parameters);
    for (Eigen::Index j = 0; j < count; ++j) of_value(i, j) = covariance(acting[i], acting[j]);
  }
  GivenJudgement judgement;
  judgement.p_absent = SurvivalOf(value, of_value);
  judgement.p_unchanged = SurvivalOf(moved, of_move);
  if (judgement.p_absent > alpha)
    judgement.state = GivenState::kNotSupported;
  else if (judgement.p_unchanged <= alpha)
    judgement.state = GivenState::kChanged;
  return judgement;
}

}  // namespace

Dataset AsSeenBy(const Machine& model, const Dataset& dataset) {
  Dataset seen = dataset;
  if (model.hexapod) seen.hexapod = model.hexapod;
  if (seen.measurement) seen.measurement = MendedMeasurement(*seen.measurement, model.effects);
  return seen;
}

std::vector<Effect> FittedEffects(const Machine& model) {
  std::vector<Effect> fitted;
  std::remove_copy_if(
      model.effects.begin(), model.effects.end(), std::back_inserter(fitted), IsFault);
  return fitted;
}

std::vector<Effect> FaultsOf(const Machine& model) {
  std::vector<Effect> faults;
  std::copy_if(model.effects.begin(), model.effects.end(), std::back_inserter(faults), IsFault);
  return faults;
}

void RequireDriversOf(const Machine& model, const Dataset& dataset) {
  const std::vector<Pose3d> reported = ReportedPoses(dataset, model);
  MachineRows(dataset, model, reported, EffectSites::kAll);
}

GivenFit FitGiven(const GapData& data,
                  const Mounts& start,
                  const std::vector<Effect>& effects,
                  const FormLibrary& library) {
  const FormLibrary free = FreeForms(effects);
  std::optional<GapProblem> at = MakeGapProblemInReach(data, start, effects, free);
  if (!at)
    throw InputError(data.dataset->robot_poses.where,
                     "poses that the model's effects put out of the legs' reach",
                     "poses inside the workspace of the model's hexapod");
  Refit refit;
  refit.mounts = start, refit.effects = effects, refit.problem = *std::move(at);
  for (int round = 0; round < kRounds; ++round) {
    const GapNoise noise = EstimateGapNoise(
        refit.problem.linear.With(AllForms(FreeForms(refit.effects))), refit.problem.trend);
    refit = RefitAsSeen(data, refit.mounts, refit.effects, noise, kWide);
  }
  GivenFit fit;
  fit.mounts = refit.mounts, fit.effects = refit.effects;
  fit.problem = MakeGapProblem(data, fit.mounts, fit.effects, library);
  const LinearProblem with = refit.problem.linear.With(AllForms(FreeForms(refit.effects)));
  fit.problem.linear.nuisance = with.nuisance;
  fit.problem.linear.shape_nuisance = with.shape_nuisance;
  return fit;
}

double LargestSize(const std::vector<Effect>& effects) {
  double largest = 0.0;
  const FormLibrary free = FreeForms(effects);
  for (const FormDefinition& form : free.forms) {
    if (form.size() == 0) continue;
    const Eigen::VectorXd sizes =
        (form.directions.transpose() * form.effect.parameters).cwiseQuotient(form.scale);
    largest = std::max(largest, std::sqrt(sizes.squaredNorm() / form.size()));
  }
  return largest;
}

std::vector<GivenJudgement> JudgeGiven(const Refit& refit,
                                       const std::vector<Effect>& given,
                                       double alpha) {
  const FormLibrary free = FreeForms(refit.effects);
  std::vector<GivenJudgement> judgements;
  Eigen::Index at = 12;
  for (std::size_t e = 0; e < given.size(); ++e) {
    const FormDefinition& form = free.forms[e];
    const Eigen::Index size = form.size();
    judgements.push_back(JudgeOne(
        refit.effects[e], given[e], form, refit.covariance.block(at, at, size, size), alpha));
    at += size;
  }
  return judgements;
}

}  // namespace hexcal
