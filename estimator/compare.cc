// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/compare.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "estimator/rms.h"
#include "residuals/whitener.h"

namespace hexcal {
namespace {

// A method is timed until so many runs or seconds are over; the fastest run counts, as others share
// the machine.
constexpr int kMostRuns = 20;
constexpr double kMostSeconds = 0.05;

class Comparing {
 public:
  Comparing(const Observations& observations,
            const std::optional<BaseAndTool>& initial,
            const CompareOptions& options)
      : observations_(observations), initial_(initial), options_(options) {}

  Comparison Run() {
    comparison_.reference =
        Calibrate(observations_, initial_, NonlinearOptionsOf(options_.calibrate));
    RunMethods();
    levels_ = LevelsOf(observations_, options_.calibrate.noise, comparison_.reference);
    comparison_.certificate = Certify(observations_, levels_, comparison_.reference);
    MonteCarloOptions monte_carlo;
    monte_carlo.draws = options_.draws;
    monte_carlo.seed = options_.seed;
    monte_carlo.threads = options_.threads;
    monte_carlo.keep_draws = options_.keep_draws;
    monte_carlo.progress = ProgressOf("repeating measurements");
    comparison_.propagation =
        options_.repeat
            ? options_.repeat(monte_carlo)
            : CheckPropagation(observations_, levels_, comparison_.reference, monte_carlo);
    MapBoth();
    return std::move(comparison_);
  }

 private:
  static CalibrateOptions NonlinearOptionsOf(CalibrateOptions options) {
    options.solver = Solver::kNonlinear;
    options.start.reset();
    options.outliers = OutlierHandling::kNotSought;
    return options;
  }

  std::function<void(long, long)> ProgressOf(std::string_view label) const {
    if (!options_.progress) return {};
    return [this, label](long done, long of) { options_.progress(label, done, of); };
  }

  void RunMethods() {
    const std::vector<int> folds =
        DrawFolds(observations_.items.size(), options_.folds, options_.seed);
    if (!folds.empty()) comparison_.folds = *std::max_element(folds.begin(), folds.end()) + 1;
    for (const MethodInfo& info : kMethods) {
      if (info.method == Method::kMarker && !options_.markers) continue;
      comparison_.methods.push_back(RunMethod(info.method, folds));
      if (options_.progress)
        options_.progress("comparing methods",
                          static_cast<long>(comparison_.methods.size()),
                          static_cast<long>(kMethods.size()));
    }
  }

  MethodResult RunMethod(Method method, const std::vector<int>& folds) const {
    const auto fit = [this, method](const Observations& observations) {
      return Fit(method, observations, initial_, options_.calibrate, options_.markers);
    };
    MethodResult result;
    result.method = method;
    Time(fit, &result);
    SetSigmas(&result);
    RmsError rms;
    for (const Observation& o : observations_.items)
      rms.Add(PoseError(result.fit.mounts, o.base_from_platform, o.world_from_tool));
    result.rmspe = rms.Position();
    result.rmsoe = rms.Orientation();
    if (!folds.empty()) result.held_out = CrossValidate(observations_, folds, fit);
    return result;
  }

  template <typename FitFunction>
  void Time(const FitFunction& fit, MethodResult* result) const {
    using Clock = std::chrono::steady_clock;
    double total = 0.0;
    result->seconds = std::numeric_limits<double>::infinity();
    for (int run = 0; run < kMostRuns && total < kMostSeconds; ++run) {
      const auto start = Clock::now();
      result->fit = fit(observations_);
      const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
      result->seconds = std::min(result->seconds, seconds);
      total += seconds;
    }
  }

  void SetSigmas(MethodResult* result) const {
    const Estimate& reference = comparison_.reference;
    result->sigmas << Minus(result->fit.mounts.world_from_base, reference.mounts.world_from_base),
        Minus(result->fit.mounts.platform_from_tool, reference.mounts.platform_from_tool);
    for (int i = 0; i < 12; ++i)
      if (reference.observability.determined[i])
        result->sigmas[i] /= std::sqrt(reference.covariance(i, i));
      else
        result->sigmas[i] = std::numeric_limits<double>::quiet_NaN();
  }

  void MapBoth() {
    if (options_.starts == 0) return;
    const Estimate& reference = comparison_.reference;
    std::vector<Matrix6d> whiteners;
    for (const Observation& o : observations_.items)
      whiteners.push_back(WhitenerOf(
          ErrorCovariance(o, observations_, reference.mounts.platform_from_tool, levels_)));
    ConvergenceMapOptions map{options_.starts, options_.seed, options_.threads, {}};
    LinearizedOptions linearized = options_.calibrate.linearized;
    map.progress = ProgressOf("mapping paper iteration");
    linearized.error = LinearizedOptions::Error::kPaper;
    comparison_.paper_map = MapConvergence(observations_.items, {}, reference, linearized, map);
    map.progress = ProgressOf("mapping twist iteration");
    linearized.error = LinearizedOptions::Error::kTwist;
    comparison_.twist_map =
        MapConvergence(observations_.items, whiteners, reference, linearized, map);
  }

  const Observations& observations_;
  const std::optional<BaseAndTool>& initial_;
  const CompareOptions& options_;
  NoiseLevels levels_;
  Comparison comparison_;
};

}  // namespace

Comparison Compare(const Observations& observations,
                   const std::optional<BaseAndTool>& initial,
                   const CompareOptions& options) {
  return Comparing(observations, initial, options).Run();
}

}  // namespace hexcal
