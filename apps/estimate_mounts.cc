// SPDX-License-Identifier: BSD-3-Clause
#include "apps/estimate_mounts.h"

#include "apps/calibrate_options.h"
#include "config/input_error.h"
#include "estimator/calibrate_markers.h"

namespace hexcal {
namespace {

// The paper's problem has nothing to do with the noise: nothing is certified of it.
bool IsByEqualWeights(const CalibrateOptions& options) {
  return options.solver == Solver::kLinearized &&
         options.linearized.error == LinearizedOptions::Error::kPaper;
}

}  // namespace

std::optional<BaseAndTool> InitialOf(const Dataset& dataset, const CalibrateOptions& options) {
  if (dataset.initial)
    return BaseAndTool{dataset.initial->world_from_base, dataset.initial->platform_from_tool};
  if (options.start == Start::kInitial)
    throw InputError(
        FileLocation(dataset.path), "no key 'initial'", "a first guess for --start=initial");
  return std::nullopt;
}

Estimate EstimateMounts(const Dataset& dataset,
                        const Observations& observations,
                        const CalibrateOptions& options) {
  const std::optional<BaseAndTool> initial = InitialOf(dataset, options);
  Estimate estimate =
      IsByMarkers(dataset, options)
          ? CalibrateMarkers(
                observations, MakeMarkerObservations(dataset, observations), initial, options)
          : Calibrate(observations, initial, options);
  if (!IsByEqualWeights(options))
    estimate.certificate =
        Certify(observations, LevelsOf(observations, options.noise, estimate), estimate);
  return estimate;
}

Machine MachineOf(const Dataset& dataset, const Estimate& estimate) {
  Machine machine{dataset.name,
                  estimate.mounts.world_from_base,
                  estimate.mounts.platform_from_tool,
                  {},
                  dataset.hexapod};
  if (estimate.tracker_from_world)
    machine.world_from_tracker = estimate.tracker_from_world->Inverse();
  return machine;
}

}  // namespace hexcal
