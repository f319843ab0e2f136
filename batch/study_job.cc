// SPDX-License-Identifier: BSD-3-Clause
#include "batch/study_job.h"

#include <fmt/format.h>

#include "batch/study_result.h"
#include "config/input_error.h"
#include "estimator/calibrate_markers.h"

namespace hexcal {
namespace {

StudyResult ResultOf(Estimate estimate) {
  StudyResult result;
  result.mounts = estimate.mounts;
  result.converged = estimate.IsTrustworthy();
  result.message = !estimate.converged        ? estimate.message
                   : estimate.IsTrustworthy() ? ""
                                              : "not all 12 parameters are determined";
  result.iterations = estimate.iterations;
  result.estimate = std::move(estimate);
  return result;
}

StudyResult FromDiscovery(const Dataset& dataset, DiscoverOptions options, std::uint64_t seed) {
  options.seed = seed >> 1;  // of its bootstraps; apart from that of the noise
  Discovery discovery = Discover(dataset, options);
  StudyResult result = ResultOf(discovery.estimate);
  result.iterations.clear();
  result.discovery = std::move(discovery);
  return result;
}

std::optional<BaseAndTool> InitialOf(const Dataset& dataset) {
  if (!dataset.initial) return std::nullopt;
  return BaseAndTool{dataset.initial->world_from_base, dataset.initial->platform_from_tool};
}

bool IsClosedForm(Method method) {
  return method == Method::kZhuang || method == Method::kShah || method == Method::kLi ||
         method == Method::kParkMartin;
}

// Those of one of compare's methods that has a covariance.
CalibrateOptions OptionsOf(const StudyEstimator& estimator) {
  CalibrateOptions options = estimator.calibrate;
  const Method method = estimator.method;
  const bool is_linearized = method == Method::kPaper || method == Method::kTwist;
  options.solver = is_linearized ? Solver::kLinearized : Solver::kNonlinear;
  if (is_linearized)
    options.linearized.error = method == Method::kPaper ? LinearizedOptions::Error::kPaper
                                                        : LinearizedOptions::Error::kTwist;
  // Kept or not sought, the numbers are the same.
  if (options.outliers == OutlierHandling::kKeep) options.outliers = OutlierHandling::kNotSought;
  if (method == Method::kRobust) options.outliers = OutlierHandling::kReject;
  return options;
}

StudyResult FromMethod(const StudyEstimator& estimator,
                       const Dataset& dataset,
                       const Observations& observations) {
  const std::optional<BaseAndTool> initial = InitialOf(dataset);
  if (IsClosedForm(estimator.method)) {
    const MethodFit fit = Fit(estimator.method, observations, initial, estimator.calibrate);
    return {fit.mounts, fit.converged, fit.message, {}, {}, {}};
  }
  const CalibrateOptions options = OptionsOf(estimator);
  if (estimator.method == Method::kMarker)
    return ResultOf(CalibrateMarkers(
        observations, MakeMarkerObservations(dataset, observations), initial, options));
  return ResultOf(Calibrate(observations, initial, options));
}

}  // namespace

StudyJob::StudyJob(Study study)
    : study_(std::move(study)), columns_(StudyColumns(study_.records)) {}

std::vector<Outcome> StudyJob::Work(std::int64_t task) const {
  const auto cells = static_cast<std::int64_t>(study_.cells.size());
  const StudyCell& cell = study_.cells[static_cast<std::size_t>(task % cells)];
  const std::uint64_t seed = SeedOf(study_, task);
  std::vector<Outcome> outcomes(study_.estimators.size());
  try {
    const Dataset dataset = DrawDataset(cell, seed);
    const Observations observations = MakeObservations(dataset);
    for (std::size_t i = 0; i < outcomes.size(); ++i) {
      const StudyEstimator& estimator = study_.estimators[i];
      const StudyResult result = estimator.discovers
                                     ? FromDiscovery(dataset, estimator.discover, seed)
                                     : FromMethod(estimator, dataset, observations);
      outcomes[i].status = result.converged ? RowStatus::kDone : RowStatus::kUntrusted;
      outcomes[i].message = result.message;
      outcomes[i].cells = StudyCells(study_, task, estimator, result);
    }
  } catch (const InputError& error) {
    for (Outcome& outcome : outcomes)
      if (outcome.cells.empty()) outcome = {RowStatus::kFailed, error.what(), {}};
  }
  return outcomes;
}

}  // namespace hexcal
