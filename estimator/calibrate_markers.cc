// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/calibrate_markers.h"

#include <fmt/format.h>
#include <glog/logging.h>

#include <algorithm>
#include <utility>

#include "estimator/judge_markers.h"
#include "estimator/marker_solver.h"
#include "estimator/reading_check.h"

namespace hexcal {

namespace {

constexpr std::size_t kMostNamed = 5;  // bad readings, in warnings of their own

class MarkerCalibration {
 public:
  MarkerCalibration(const Observations& observations,
                    const MarkerObservations& markers,
                    const std::optional<BaseAndTool>& initial,
                    const CalibrateOptions& options)
      : all_(observations), all_markers_(markers), initial_(initial), options_(options) {
    by_poses_ = options;
    by_poses_.outliers = OutlierHandling::kNotSought;
    // A start needs no noise level: positions and orientations count by how far they spread.
    by_poses_.noise.reset();
    if (!observations.tool_noise_is_known) by_poses_.noise = Spread(observations.items);
  }

  Estimate Run() {
    Estimate estimate = FitAroundOutliers(
        all_, {}, options_.outliers, options_.snooping, [this](const Observations& some) {
          return some.items.size() == all_.items.size()
                     ? Fit(all_, all_markers_)
                     : Fit(some, Restricted(all_markers_, all_, some));
        });
    AddMisfitsOfRejected(&estimate);
    if (options_.outliers != OutlierHandling::kNotSought && estimate.IsTrustworthy())
      WarnOfReadings(&estimate);
    return estimate;
  }

 private:
  Estimate Fit(const Observations& observations, const MarkerObservations& markers) {
    const Estimate start = Calibrate(observations, initial_, by_poses_);
    MarkerSolverOptions options{
        options_.nonlinear, options_.evaluation == Evaluation::kPerPose, options_.threads};
    if (!start.converged) options.nonlinear.max_iterations = 0;  // there is nothing to refine
    solution_ = SolveMarkers(markers, start.mounts, options);

    Estimate estimate;
    estimate.warnings = observations.warnings;
    if (options_.noise)
      estimate.warnings.push_back(
          "the noise that was given is of measured poses; a calibration by markers does not use "
          "it");
    const Solution& solution = solution_.solution;
    estimate.mounts = solution.mounts;
    estimate.converged = start.converged && solution.converged;
    estimate.message = start.converged ? solution.message : start.message;
    estimate.iterations = start.iterations;
    estimate.iterations.insert(
        estimate.iterations.end(), solution.iterations.begin() + 1, solution.iterations.end());
    JudgeMarkers(observations, markers, solution_, &estimate);
    return estimate;
  }

  // Against what the others' fit predicts, as the residuals of their poses.
  void AddMisfitsOfRejected(Estimate* estimate) const {
    if (options_.outliers != OutlierHandling::kReject || estimate->outliers.empty()) return;
    const auto misfits = MisfitsByItem(all_markers_, all_.items.size(), solution_);
    for (std::size_t i = 0; i < misfits.size(); ++i)
      if (estimate->poses[i].weight == 0.0) estimate->poses[i].markers = misfits[i];
  }

  void WarnOfReadings(Estimate* estimate) const {
    ReadingOptions options;
    options.threads = options_.threads;
    const std::vector<ReadingCheck> bad =
        FindBadReadings(all_markers_, estimate->mounts, estimate->outliers, options).Bad();
    for (std::size_t i = 0; i < std::min(bad.size(), kMostNamed); ++i)
      estimate->warnings.push_back(fmt::format("the others contradict {}; it {}",
                                               ReadingWords(bad[i], all_.items[bad[i].item].label),
                                               estimate->poses[bad[i].item].weight > 0.0
                                                   ? "is used all the same"
                                                   : "is left out with its pose"));
    if (bad.size() > kMostNamed)
      estimate->warnings.push_back(fmt::format("the others contradict {} more readings of markers",
                                               bad.size() - kMostNamed));
  }

  const Observations& all_;
  const MarkerObservations& all_markers_;
  const std::optional<BaseAndTool>& initial_;
  const CalibrateOptions& options_;
  CalibrateOptions by_poses_;
  MarkerSolution solution_;
};

}  // namespace

Estimate CalibrateMarkers(const Observations& observations,
                          const MarkerObservations& markers,
                          const std::optional<BaseAndTool>& initial,
                          const CalibrateOptions& options) {
  CHECK(options.solver == Solver::kNonlinear) << "the linearized iteration knows no markers";
  return MarkerCalibration(observations, markers, initial, options).Run();
}

}  // namespace hexcal
