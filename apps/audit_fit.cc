// SPDX-License-Identifier: BSD-3-Clause
#include "apps/audit_fit.h"

#include <algorithm>
#include <memory>

#include "apps/audit_repetition.h"
#include "apps/audit_screening.h"
#include "apps/calibrate_options.h"
#include "apps/estimate_mounts.h"
#include "apps/flags.h"
#include "apps/in_order.h"
#include "apps/message.h"
#include "apps/record_of.h"
#include "apps/stage_bars.h"
#include "estimator/calibrate_grown.h"
#include "estimator/grown_repeat.h"

namespace hexcal {
namespace {

// Repetitions of a joint fit take as much longer; they are as many fewer.
constexpr int kPlainFitsInAJointOne = 20;
constexpr int kFewestJointFits = 100;
constexpr int kMostJointRounds = 4;

// What the plain fit and that with the effects of a model both come to.
struct Fitted {
  Observations observations;  // that the estimate is of
  Estimate estimate;
  Comparison comparison;
  NoiseLevels levels;
  ResultHeader header;
  std::optional<RepeatedAs> repeated;
  std::shared_ptr<const GrownTarget> grown;
  Machine machine;
};

CompareOptions ComparisonOf(const Dataset& dataset,
                            const CalibrateOptions& options,
                            StageBars* bars) {
  CompareOptions compare;
  compare.calibrate = options;
  compare.calibrate.loss = {};
  compare.calibrate.covariance = CovarianceKind::kModel;
  compare.folds = FLAGS_folds;
  compare.draws = FLAGS_draws;
  compare.keep_draws = true;
  compare.starts = 0;
  compare.seed = static_cast<std::uint64_t>(FLAGS_seed);
  compare.threads = options.threads;
  compare.progress = [bars](std::string_view label, long done, long of) {
    bars->Update(label, done, of);
  };
  if (dataset.measurement->kind == Measurement::Kind::kMarkers)
    compare.markers = [&dataset](const Observations& some) {
      return MakeMarkerObservations(dataset, some);
    };
  return compare;
}

Fitted FitPlain(const Dataset& dataset, const CalibrateOptions& options, StageBars* bars) {
  Fitted fitted;
  const bool by_markers = IsByMarkers(dataset, options);
  fitted.observations = MakeObservations(dataset);
  fitted.estimate = EstimateMounts(dataset, fitted.observations, options);
  fitted.header = HeaderOf(dataset.name, options, by_markers);
  CompareOptions compare = ComparisonOf(dataset, options, bars);
  AuditRepetition repetition(dataset, fitted.observations, options, fitted.header, fitted.estimate);
  compare.repeat = [&](const MonteCarloOptions& repeat) { return repetition.Run(repeat); };
  fitted.comparison = Compare(fitted.observations, InitialOf(dataset, options), compare);
  fitted.levels = LevelsOf(fitted.observations,
                           options.noise,
                           by_markers ? fitted.comparison.reference : fitted.estimate);
  fitted.repeated = repetition.repeated();
  fitted.machine = MachineOf(dataset, fitted.estimate);
  return fitted;
}

// Jointly with the effects of a model; methods are compared by poses without effects.
Fitted FitGrown(const Dataset& dataset,
                const Machine& model,
                const CalibrateOptions& options,
                StageBars* bars) {
  Fitted fitted;
  GrownCalibration grown = CalibrateGrown(dataset, model, options);
  fitted.machine = grown.machine;
  const GrownSolution& solution = *grown.solution;
  if (dataset.measurement->kind == Measurement::Kind::kMarkers)
    PrintWarning(dataset.name +
                 ": with the effects of a --model the fit is by poses, made of the markers' "
                 "readings; it is not by the readings themselves, as without a model");
  CompareOptions compare = ComparisonOf(dataset, options, bars);
  compare.markers = {};
  compare.repeat = [&](MonteCarloOptions repeat) {
    repeat.draws = std::max(repeat.draws / kPlainFitsInAJointOne, kFewestJointFits);
    repeat.most_rounds = kMostJointRounds;
    return CheckGrownPropagation(solution, grown.estimate, repeat);
  };
  fitted.comparison = Compare(solution.cleaned, InitialOf(dataset, options), compare);
  fitted.levels = LevelsOf(solution.cleaned, options.noise, fitted.comparison.reference);
  if (grown.estimate.converged) fitted.grown = std::make_shared<const GrownTarget>(grown.solution);
  fitted.header = HeaderOf(dataset.name, options, false);
  fitted.observations = solution.observations;
  fitted.estimate = std::move(grown.estimate);
  return fitted;
}

}  // namespace

AuditedMachine FitAndAudit(const AuditTask& task) {
  CalibrateOptions options = CalibrateOptionsFromFlags();
  options.threads = ThreadsFor(FLAGS_threads);
  StageBars bars(FLAGS_quiet);
  Fitted fitted = task.model ? FitGrown(task.dataset, *task.model, options, &bars)
                             : FitPlain(task.dataset, options, &bars);
  fitted.header.readings = ReadingsOf(task.dataset);
  AuditInput input = {task.dataset,
                      fitted.observations,
                      fitted.levels,
                      std::move(fitted.header),
                      std::move(fitted.estimate),
                      std::move(fitted.comparison),
                      task.requirements,
                      task.earlier,
                      static_cast<std::uint64_t>(FLAGS_seed),
                      std::move(fitted.grown)};
  input.repeated = std::move(fitted.repeated);
  input.threads = options.threads;
  ScreenFor(task.model, &bars, &input);
  return {MakeAudit(std::move(input)), std::move(fitted.machine)};
}

}  // namespace hexcal
