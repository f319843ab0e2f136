// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/calibrate.h"

#include <fmt/format.h>
#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "estimator/closed_form.h"
#include "estimator/judge.h"
#include "estimator/noise.h"
#include "estimator/normal_matrix.h"
#include "estimator/plausibility.h"
#include "estimator/pose_fit.h"
#include "estimator/rms.h"
#include "estimator/start.h"
#include "estimator/weights.h"

namespace hexcal {
namespace {

// Rounds of fit and noise estimate; each takes the change down by a factor of ten or more.
constexpr int kMaxRounds = 30;
// A change by this part of a sigma, or by so many roundings of the data, is none.
constexpr double kSettled = 1e-8;
constexpr double kRoundings = 64.0;
// A change of less than 1e-3 sigma that no longer shrinks is rounding.
constexpr double kStalled = 1e-3 / kSettled;
// The iteration's update, m and rad, below which its residuals tell the noise.
constexpr double kNear = 1e-4;

class Calibration {
 public:
  Calibration(const Observations& observations,
              const std::optional<BaseAndTool>& initial,
              const CalibrateOptions& options)
      : observations_(observations),
        few_(EvenSample(observations.items)),
        initial_(initial),
        options_(options) {
    weighting_.paper_error =
        IsLinearized() && options.linearized.error == LinearizedOptions::Error::kPaper;
    weighting_.levels_estimated = !observations.tool_noise_is_known && !options.noise;
    weighting_.levels = options.noise.value_or(Spread(few_));
    weighting_.loss = options.loss;
    weighting_.covariance = options.covariance;
    CHECK(!IsLinearized() || (!HasLoss() && options.covariance == CovarianceKind::kModel))
        << "the linearized iteration knows neither loss nor sandwich";
  }

  Estimate Run() {
    estimate_.warnings = observations_.warnings;
    if (options_.noise && observations_.tool_noise_is_known)
      estimate_.warnings.push_back(
          "the dataset states its noise; the noise given beside it is not used");
    estimate_.mounts = FirstGuess();
    if (HasLoss()) StartRobustly();
    if (weighting_.paper_error)
      FitAsThePaper();
    else if (IsLinearized())
      FitByTwist();
    else
      FitNonlinear();
    if (estimate_.converged)
      Refuse(WhyNoSolution(few_, estimate_.mounts, ChosenStart() != Start::kClosedForm));
    if (HasLoss()) RefuseLostPoses();
    if (!estimate_.converged && weighting_.levels_estimated) {
      TakeResidualsAsNoise();
      sums_.reset();
    }
    Judge(observations_, weighting_, sums_, &estimate_);
    return std::move(estimate_);
  }

 private:
  bool IsLinearized() const { return options_.solver == Solver::kLinearized; }
  bool HasLoss() const { return options_.loss.kind != LossKind::kNone; }

  // A loss needs a start that outliers have not drawn to themselves, and a noise without them that
  // says from where on an error is large.
  void StartRobustly() {
    const OutlierSearch search = FindOutliers(observations_, options_.noise, options_.snooping);
    if (!options_.start) estimate_.mounts = search.mounts;
    if (weighting_.levels_estimated) weighting_.levels = search.levels;
  }

  Start ChosenStart() const {
    const Start usual = !IsLinearized() ? Start::kClosedForm
                        : initial_      ? Start::kInitial
                                        : Start::kIdentity;
    return options_.start.value_or(usual);
  }

  BaseAndTool FirstGuess() const {
    switch (ChosenStart()) {
      case Start::kClosedForm:
        return FindStart(few_);
      case Start::kShah:
        return SolveClosedForm(ClosedForm::kShah, observations_.items);
      case Start::kParkMartin:
        return SolveClosedForm(ClosedForm::kParkMartin, observations_.items);
      case Start::kInitial:
        CHECK(initial_) << "no initial guess";
        return *initial_;
      case Start::kIdentity:
        break;
    }
    return {};
  }

  // Equal weights do not follow the noise; the covariance does.
  void FitAsThePaper() {
    Take(SolveLinearized(observations_.items, {}, estimate_.mounts, options_.linearized));
    if (weighting_.levels_estimated)
      weighting_.levels =
          EstimateNoise(observations_, estimate_.mounts, Spread(observations_.items));
  }

  bool IsStreamed() const { return evaluation_ == Evaluation::kStreamed; }

  // Levels that are not known are found in the same passes, but where the robot's own noise makes
  // the weights depend on the tool. Where sums of squares lose the weakest direction, rows decide.
  void FitNonlinear() {
    const BaseAndTool start = estimate_.mounts;
    const Weighting weighting = weighting_;
    if (IsStreamed()) {
      batch_.Reserve(observations_.items.size());
      for (const Observation& o : observations_.items)
        batch_.Add(o.base_from_platform, o.world_from_tool);
      if (observations_.has_robot_noise)
        FitInRounds();
      else
        FitStreamed(LevelsMove() ? std::nullopt : std::optional(Weights()));
      if (KeepsItsWeakest(sums_->equations.normal)) return;
      sums_.reset();
      estimate_.iterations.clear();
      estimate_.mounts = start;
      weighting_ = weighting;
      evaluation_ = Evaluation::kPerPose;
    }
    FitInRounds();
  }

  void FitStreamed(const std::optional<PoseWeights>& weights) {
    PoseFitOptions options;
    options.nonlinear = options_.nonlinear;
    options.threads = options_.threads;
    options.loss = options_.loss;
    const PoseFit fit = FitPoses(batch_, weights ? &*weights : nullptr, estimate_.mounts, options);
    Take(fit.solution);
    sums_ = {fit.equations, fit.variances};
    if (fit.variances)
      weighting_.levels = {std::sqrt(fit.variances->values[0]),
                           std::sqrt(fit.variances->values[1])};
  }

  PoseWeights Weights() const {
    return WeightsOf(observations_, estimate_.mounts.platform_from_tool, weighting_.levels);
  }

  // Weights follow the noise and (through the robot's noise) the tool; both follow the fit: in
  // turn, until nothing moves but rounding.
  void FitInRounds() {
    double last = std::numeric_limits<double>::infinity();
    for (int round = 0; round < kMaxRounds; ++round) {
      const BaseAndTool mounts = estimate_.mounts;
      const NoiseLevels levels = weighting_.levels;
      if (IsStreamed())
        FitStreamed(Weights());
      else
        Take(SolveNonlinear(
            observations_.items, Whiteners(), mounts, options_.nonlinear, options_.loss));
      EstimateLevels();
      if (!estimate_.converged || !WeightsMove()) return;
      const double change = Change(mounts, levels);
      if (round > 0 && (change < 1.0 || (change < kStalled && change > 0.5 * last))) return;
      last = change;
    }
    Refuse(fmt::format("the weights did not settle within {} rounds", kMaxRounds));
  }

  // The same with the weights moved along at every iteration, once the first ones have brought it
  // near.
  void FitByTwist() {
    LinearizedOptions options = options_.linearized;
    if (WeightsMove()) options.tolerance = std::max(options.tolerance, kNear);
    Take(SolveLinearized(observations_.items, Whiteners(), estimate_.mounts, options));
    NoiseLevels levels = weighting_.levels;
    EstimateLevels();
    if (!estimate_.converged || !WeightsMove()) return;
    options.tolerance = options_.linearized.tolerance;
    const int at_most = std::exchange(options.max_iterations, 1);
    do {
      if (static_cast<int>(estimate_.iterations.size()) > at_most) {
        Refuse(fmt::format("the weights did not settle within {} iterations", at_most));
        return;
      }
      levels = weighting_.levels;
      Take(SolveLinearized(observations_.items, Whiteners(), estimate_.mounts, options));
      EstimateLevels();
    } while (!estimate_.converged || Change(estimate_.mounts, levels) >= 1.0);
  }

  bool LevelsMove() const { return weighting_.levels_estimated && !HasLoss(); }
  bool WeightsMove() const { return LevelsMove() || observations_.has_robot_noise; }

  void EstimateLevels() {
    if (LevelsMove())
      weighting_.levels = EstimateNoise(observations_, estimate_.mounts, weighting_.levels);
  }

  std::vector<Matrix6d> Whiteners() const {
    return WhitenersOf(observations_, estimate_.mounts.platform_from_tool, weighting_.levels);
  }

  // Where there is no solution, all that is left over is noise.
  void TakeResidualsAsNoise() {
    RmsError rms;
    for (const Observation& o : observations_.items)
      rms.Add(PoseError(estimate_.mounts, o.base_from_platform, o.world_from_tool));
    const NoiseLevels rounding = Rounding(observations_.items);
    weighting_.levels = {std::max(rms.Position() / std::sqrt(3.0), rounding.position),
                         std::max(rms.Orientation() / std::sqrt(3.0), rounding.orientation)};
  }

  // What has converged may still be no solution.
  bool Refuse(const std::string& why) {
    if (why.empty()) return false;
    estimate_.converged = false;
    estimate_.message = why;
    return true;
  }

  // All count again then, so that what is left over has a size.
  void RefuseLostPoses() {
    if (!Refuse(
            WhyNothingCounts(observations_.items, Whiteners(), estimate_.mounts, weighting_.loss)))
      return;
    weighting_.loss = {};
    sums_.reset();
  }

  // The records of a later round begin at the end of the one before.
  void Take(const Solution& solution) {
    estimate_.mounts = solution.mounts;
    estimate_.converged = solution.converged;
    estimate_.message = solution.message;
    const std::ptrdiff_t skip = estimate_.iterations.empty() ? 0 : 1;
    estimate_.iterations.insert(
        estimate_.iterations.end(), solution.iterations.begin() + skip, solution.iterations.end());
  }

  // Of mounts and noise levels since then; below 1 it does not matter.
  double Change(const BaseAndTool& mounts, const NoiseLevels& levels) const {
    const Matrix6d c = ErrorCovariance(observations_.items[0],
                                       observations_,
                                       estimate_.mounts.platform_from_tool,
                                       weighting_.levels);
    const NoiseLevels rounding = Rounding(observations_.items);
    const double metre = std::max(kSettled * std::sqrt(c.diagonal().head<3>().mean()),
                                  kRoundings * rounding.position);
    const double radian = std::max(kSettled * std::sqrt(c.diagonal().tail<3>().mean()),
                                   kRoundings * rounding.orientation);
    const Vector6d base = Minus(estimate_.mounts.world_from_base, mounts.world_from_base);
    const Vector6d tool = Minus(estimate_.mounts.platform_from_tool, mounts.platform_from_tool);
    const Vector6d moved = base.cwiseAbs().cwiseMax(tool.cwiseAbs());
    return std::max({moved.head<3>().maxCoeff() / metre,
                     moved.tail<3>().maxCoeff() / radian,
                     std::abs(weighting_.levels.position - levels.position) / metre,
                     std::abs(weighting_.levels.orientation - levels.orientation) / radian});
  }

  const Observations& observations_;
  const std::vector<Observation> few_;  // for what need not see all of many
  const std::optional<BaseAndTool>& initial_;
  const CalibrateOptions& options_;
  Evaluation evaluation_ = options_.evaluation;
  Weighting weighting_;
  PoseBatch batch_;
  std::optional<FitSums> sums_;
  Estimate estimate_;
};

}  // namespace

Estimate Calibrate(const Observations& observations,
                   const std::optional<BaseAndTool>& initial,
                   const CalibrateOptions& options) {
  return FitAroundOutliers(
      observations,
      options.noise,
      options.outliers,
      options.snooping,
      [&](const Observations& some) { return Calibration(some, initial, options).Run(); });
}

}  // namespace hexcal
