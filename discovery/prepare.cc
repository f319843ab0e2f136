// SPDX-License-Identifier: BSD-3-Clause
#include "discovery/prepare.h"

#include <glog/logging.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "discovery/given.h"
#include "discovery/swapped_markers.h"
#include "estimator/calibrate.h"
#include "model/data_fault.h"
#include "model/predict.h"

namespace hexcal {
namespace {

void Report(const Investigation& work, const char* stage) {
  if (work.options.progress) work.options.progress(stage, 0, 1);
}

// What a model says of the data is taken as it is.
void TakeModel(const Machine& model, Investigation* work) {
  RequireDriversOf(model, work->dataset);
  work->given = FittedEffects(model);
  work->given_faults = FaultsOf(model);
  work->reported = ReportedPoses(work->dataset, model);
  work->robot_is_mended =
      std::any_of(work->given_faults.begin(), work->given_faults.end(), [](const Effect& fault) {
        return fault.name != "swapped_markers";  // mended already, and not the robot's
      });
}

void MendFaults(Investigation* work) {
  Report(*work, "faults of the data");
  if (work->options.model) TakeModel(*work->options.model, work);
  if (work->robot_is_mended) return;
  work->reported = ReportedPoses(work->dataset);
  if (const std::optional<FaultFound> fault = FindFault(work->dataset, work->observations)) {
    Machine machine;
    machine.hexapod = work->dataset.hexapod;
    machine.effects = {fault->effect};
    work->reported = ReportedPoses(work->dataset, machine);
    work->faults.push_back(*fault);
    work->robot_is_mended = true;
  }
}

Estimate Calibrate12(Investigation* work) {
  CalibrateOptions options;
  options.noise = work->options.noise;
  options.threads = work->options.threads;
  Estimate estimate = Calibrate(work->observations, std::nullopt, options);
  if (!work->robot_is_mended) return estimate;
  const ToolPoses tools = ComputeToolPoses(work->dataset);
  for (std::size_t i = 0; i < work->observations.items.size(); ++i)
    work->observations.items[i].base_from_platform = work->reported[tools.poses[i].pose];
  return Calibrate(work->observations, std::nullopt, options);
}

}  // namespace

MendedDataset MendMarkers(const Dataset& dataset, const DiscoverOptions& options) {
  if (options.model) CHECK(!options.model->pose_map) << "a model with a pose map";
  MendedDataset mended = {options.model ? AsSeenBy(*options.model, dataset) : dataset, {}};
  mended.swaps = FindSwappedMarkers(mended.dataset);
  for (const FaultFound& swap : mended.swaps)
    mended.dataset.measurement = MendedMeasurement(*mended.dataset.measurement, {swap.effect});
  return mended;
}

Prepared Prepare(Investigation* work) {
  MendFaults(work);
  Prepared start;
  start.base_and_tool = Calibrate12(work);
  start.mounts = {start.base_and_tool.mounts.world_from_base,
                  start.base_and_tool.mounts.platform_from_tool};
  work->data = MakeGapData(work->dataset, work->reported);
  work->library = MakeFormLibrary(work->dataset, work->data.visits, work->data.rows);
  if (work->given.empty()) {
    work->problem = MakeGapProblem(work->data, start.mounts, {}, work->library);
    return start;
  }
  Report(*work, "the given model");
  GivenFit fit = FitGiven(work->data, start.mounts, work->given, work->library);
  start.mounts = fit.mounts;
  start.given_now = std::move(fit.effects);
  work->problem = std::move(fit.problem);
  return start;
}

Selection SelectEffects(const Investigation& work, int most_effects) {
  SelectOptions options;
  options.alpha = work.options.alpha;
  options.bootstraps = work.options.bootstraps;
  options.most_effects = most_effects;
  options.seed = work.options.seed;
  options.progress = [&](int step) {
    if (work.options.progress) work.options.progress("search", step, most_effects + 1);
  };
  return Select(work.problem.linear, work.problem.trend, options);
}

}  // namespace hexcal
