// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/calibrate.h"

#include <fmt/format.h>
#include <glog/logging.h>

#include <algorithm>
#include <cmath>

#include "estimator/closed_form.h"
#include "estimator/judge.h"
#include "estimator/noise.h"
#include "residuals/whitener.h"

namespace hexcal {
namespace {

// Rounds of fit and noise estimate; each takes the change down by a factor of ten or more.
constexpr int kMaxRounds = 30;
constexpr double kRoundTolerance = 1e-11;

class Calibration {
 public:
  Calibration(const Observations& observations,
              const std::optional<BaseAndTool>& initial,
              const CalibrateOptions& options)
      : observations_(observations), initial_(initial), options_(options) {
    weighting_.paper_error =
        IsLinearized() && options.linearized.error == LinearizedOptions::Error::kPaper;
    weighting_.levels_estimated = !observations.tool_noise_is_known && !options.noise;
    if (options.noise) weighting_.levels = *options.noise;
  }

  Estimate Run() {
    estimate_.warnings = observations_.warnings;
    if (options_.noise && observations_.tool_noise_is_known)
      estimate_.warnings.push_back(
          "the dataset states its noise; the noise given beside it is not used");
    estimate_.mounts = FirstGuess();
    if (weighting_.paper_error)
      FitAsThePaper();
    else
      FitWeighted();
    Judge(observations_, weighting_, &estimate_);
    return std::move(estimate_);
  }

 private:
  bool IsLinearized() const { return options_.solver == Solver::kLinearized; }

  BaseAndTool FirstGuess() const {
    const Start usual = !IsLinearized() ? Start::kClosedForm
                        : initial_      ? Start::kInitial
                                        : Start::kIdentity;
    switch (options_.start.value_or(usual)) {
      case Start::kClosedForm:
        return BestClosedForm(observations_.items);
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

  void FitAsThePaper() {
    Take(SolveLinearized(observations_.items, {}, estimate_.mounts, options_.linearized));
    if (!weighting_.levels_estimated) return;
    std::vector<Matrix6d> error_derivatives;
    for (const Observation& o : observations_.items)
      error_derivatives.push_back(
          PaperErrorDerivative(estimate_.mounts.world_from_base * o.base_from_platform *
                               estimate_.mounts.platform_from_tool));
    weighting_.levels =
        EstimateNoiseOfEqualWeights(observations_, estimate_.mounts, error_derivatives);
  }

  // Weights follow the noise and (through the robot's noise) the tool; both follow the fit: in
  // turn, until nothing moves.
  void FitWeighted() {
    const bool weights_move = weighting_.levels_estimated || observations_.has_robot_noise;
    if (weighting_.levels_estimated) {
      if (IsLinearized())
        Take(SolveLinearized(observations_.items, {}, estimate_.mounts, options_.linearized));
      weighting_.levels = RoughNoise(observations_, estimate_.mounts);
    }
    for (int round = 0; round < kMaxRounds; ++round) {
      const BaseAndTool mounts = estimate_.mounts;
      const NoiseLevels levels = weighting_.levels;
      Take(SolveOnce());
      if (!estimate_.converged || !weights_move) return;
      if (weighting_.levels_estimated)
        weighting_.levels = EstimateNoise(observations_, estimate_.mounts, levels);
      if (round > 0 && Change(mounts, levels) < kRoundTolerance) return;
    }
    estimate_.converged = false;
    estimate_.message = fmt::format("the weights did not settle within {} rounds", kMaxRounds);
  }

  Solution SolveOnce() const {
    std::vector<Matrix6d> whiteners;
    whiteners.reserve(observations_.items.size());
    for (const Observation& o : observations_.items)
      whiteners.push_back(WhitenerOf(ErrorCovariance(
          o, observations_, estimate_.mounts.platform_from_tool, weighting_.levels)));
    if (!IsLinearized())
      return SolveNonlinear(observations_.items, whiteners, estimate_.mounts, options_.nonlinear);
    LinearizedOptions options = options_.linearized;
    const int used = std::max(0, static_cast<int>(estimate_.iterations.size()) - 1);
    options.max_iterations = std::max(0, options.max_iterations - used);
    return SolveLinearized(observations_.items, whiteners, estimate_.mounts, options);
  }

  // The records of a later round begin at the end of the one before.
  void Take(const Solution& solution) {
    estimate_.mounts = solution.mounts;
    estimate_.converged = solution.converged;
    estimate_.message = solution.message;
    const std::size_t skip = estimate_.iterations.empty() ? 0 : 1;
    estimate_.iterations.insert(
        estimate_.iterations.end(), solution.iterations.begin() + skip, solution.iterations.end());
  }

  // Of the mounts, m and rad, and of the noise levels, a thousandth of their ratio.
  double Change(const BaseAndTool& mounts, const NoiseLevels& levels) const {
    const auto moved = [](const Pose3d& a, const Pose3d& b) {
      return Minus(a, b).cwiseAbs().maxCoeff();
    };
    const double of_mounts =
        std::max(moved(estimate_.mounts.world_from_base, mounts.world_from_base),
                 moved(estimate_.mounts.platform_from_tool, mounts.platform_from_tool));
    if (!weighting_.levels_estimated) return of_mounts;
    const auto ratio = [](double a, double b) { return 1e-3 * std::abs(a / b - 1.0); };
    return std::max({of_mounts,
                     ratio(weighting_.levels.position, levels.position),
                     ratio(weighting_.levels.orientation, levels.orientation)});
  }

  const Observations& observations_;
  const std::optional<BaseAndTool>& initial_;
  const CalibrateOptions& options_;
  Weighting weighting_;
  Estimate estimate_;
};

}  // namespace

Estimate Calibrate(const Observations& observations,
                   const std::optional<BaseAndTool>& initial,
                   const CalibrateOptions& options) {
  return Calibration(observations, initial, options).Run();
}

}  // namespace hexcal
