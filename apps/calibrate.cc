// SPDX-License-Identifier: BSD-3-Clause
#include "apps/calibrate.h"

#include <fmt/format.h>

#include <chrono>
#include <limits>
#include <memory>
#include <optional>

#include "apps/calibrate_options.h"
#include "apps/dataset_files.h"
#include "apps/estimate_mounts.h"
#include "apps/exit_status.h"
#include "apps/flags.h"
#include "apps/history_entry.h"
#include "apps/in_order.h"
#include "apps/message.h"
#include "apps/output_folder.h"
#include "apps/progress.h"
#include "apps/record_of.h"
#include "apps/report_page.h"
#include "config/input_error.h"
#include "estimator/calibrate_grown.h"
#include "model/machine.h"
#include "report/calibrate_html.h"
#include "report/result_table.h"

namespace hexcal {
namespace {

std::vector<OutputFile> ResultFiles() {
  std::vector<OutputFile> files = {{"result.json", std::string(kResultMark)},
                                   {"model.yaml", std::string(kModelMark)},
                                   {"run.json", std::string(kRunMark)}};
  if (FLAGS_report) files.push_back(ReportPage("calibrate"));
  return files;
}

struct Job {
  Dataset dataset;
  OutputFolder folder;
};

// What came of a dataset: an estimate, or why there is none.
struct Outcome {
  std::optional<Estimate> estimate;
  std::optional<Machine> grown;  // of a model with effects
  std::shared_ptr<const GrownSolution> solution;
  std::string refusal;
  double seconds = 0.0;
};

class CalibrateRun {
 public:
  explicit CalibrateRun(const std::vector<std::string>& files)
      : files_(files), options_(CalibrateOptionsFromFlags()), threads_(ThreadsFor(FLAGS_threads)) {
    if (FLAGS_model.empty()) return;
    model_ = ReadMachine(FLAGS_model);
    if (HasEffects()) RequireOptionsForEffects(options_);
  }

  int Run() {
    OpenAll();
    CheckHistoryFlag();
    {
      Progress progress("calibrating", FLAGS_quiet);
      // One dataset has the threads to itself; several share them.
      if (jobs_.size() == 1) options_.threads = threads_;
      if (jobs_.size() == 1)
        options_.nonlinear.after_iteration = [&progress](int done, int at_most) {
          progress.Update(done, at_most);
        };
      ForEachInOrder<Outcome>(
          jobs_.size(),
          threads_,
          [this](std::size_t i) { return Work(jobs_[i].dataset); },
          [this, &progress](std::size_t i, const Outcome& outcome) {
            Finish(&jobs_[i], outcome);
            if (i + 1 < jobs_.size())
              progress.Update(static_cast<long>(i + 1), static_cast<long>(jobs_.size()));
          });
    }
    if (failed_ > 0) {
      PrintError(fmt::format("{} of {} datasets failed", failed_, files_.size()));
      return kSomeFailed;
    }
    return untrusted_ > 0 ? kNotTrusted : kDone;
  }

 private:
  // Of several datasets, a bad one does not keep the others from being done.
  void Refuse(const InputError& error) {
    if (files_.size() == 1) throw error;
    PrintError(error.what());
    ++failed_;
  }

  void OpenAll() {
    std::vector<Dataset> datasets;
    std::vector<std::pair<std::string, std::string>> names;
    for (const std::string& file : files_) try {
        datasets.push_back(OpenDataset(file, true));
        IsByMarkers(datasets.back(), options_);  // wrong usage shows before anything is computed
        names.emplace_back(file, datasets.back().name);
      } catch (const InputError& error) {
        Refuse(error);
      }
    RequireDistinctNames(names);
    for (Dataset& dataset : datasets) {
      OutputFolder folder(
          FLAGS_out, dataset.name, ResultFiles(), InputFiles(dataset, FLAGS_model), FLAGS_force);
      jobs_.push_back({std::move(dataset), std::move(folder)});
    }
  }

  bool HasEffects() const { return !model_.effects.empty() || model_.pose_map.has_value(); }
  bool IsByMarkersHere(const Dataset& dataset) const {
    return !HasEffects() && IsByMarkers(dataset, options_);
  }

  void EstimateWithEffects(const Dataset& dataset, Outcome* outcome) const {
    InitialOf(dataset, options_);  // refuses a start that the dataset does not have
    GrownCalibration grown = CalibrateGrown(dataset, model_, options_);
    outcome->estimate = std::move(grown.estimate);
    outcome->grown = std::move(grown.machine);
    outcome->solution = std::move(grown.solution);
  }

  Outcome Work(const Dataset& dataset) const {
    const auto start = std::chrono::steady_clock::now();
    Outcome outcome;
    try {
      if (HasEffects())
        EstimateWithEffects(dataset, &outcome);
      else
        outcome.estimate = EstimateMounts(dataset, MakeObservations(dataset), options_);
    } catch (const InputError& error) {
      outcome.refusal = error.what();
    }
    outcome.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return outcome;
  }

  void Finish(Job* job, const Outcome& outcome) {
    if (!outcome.estimate) return Refuse(InputError(outcome.refusal));
    const Estimate& estimate = *outcome.estimate;
    ResultHeader header = HeaderOf(job->dataset.name, options_, IsByMarkersHere(job->dataset));
    header.readings = ReadingsOf(job->dataset);
    const Machine machine = outcome.grown ? *outcome.grown : MachineOf(job->dataset, estimate);
    const std::string result = ResultJson(header, estimate, machine.effects);
    RunRecord record = RecordOf("calibrate", job->dataset, outcome.seconds, threads_);
    record.inputs = InputFiles(job->dataset, FLAGS_model);
    HistoryEntry entry(
        "calibrate", job->dataset, record, header, estimate, machine.effects, result);
    record.history = entry.mark();
    std::vector<std::pair<std::string, std::string>> files = {{"result.json", result},
                                                              {"model.yaml", WriteMachine(machine)},
                                                              {"run.json", RunJson(record)}};
    if (FLAGS_report) {
      // With faults of the data mended, where the model knows some.
      const Observations observations =
          outcome.solution ? outcome.solution->observations : MakeObservations(job->dataset);
      files.emplace_back("report.html",
                         CalibrateHtml(header,
                                       record,
                                       estimate,
                                       FrameGraphOf(job->dataset, {}),
                                       MakeScene(job->dataset, observations, estimate),
                                       MakeLeftOver(job->dataset, observations, estimate)));
    }
    job->folder.Write(files);
    entry.Append();
    if (!estimate.IsTrustworthy()) ++untrusted_;
    PrintNewWarnings(job->dataset, estimate.warnings, "result.json");
    Print(*job, header, estimate, machine.effects);
  }

  static void Print(const Job& job,
                    const ResultHeader& header,
                    const Estimate& estimate,
                    const std::vector<Effect>& effects) {
    if (FLAGS_quiet) return;
    Progress::ClearVisible();
    if (FLAGS_json)
      fmt::print("{}\n", ResultJsonLine(header, estimate, effects));
    else
      fmt::print("{}  written to     {}\n\n", ResultTable(header, estimate), job.folder.path());
  }

  const std::vector<std::string>& files_;
  CalibrateOptions options_;
  int threads_;
  Machine model_;  // whose effects are estimated; empty without --model
  std::vector<Job> jobs_;
  int failed_ = 0;
  int untrusted_ = 0;
};

int RunCalibrate(const std::vector<std::string>& files) { return CalibrateRun(files).Run(); }

}  // namespace

Command CalibrateCommand() {
  return {
      "calibrate",
      "where the base and the tool are, and how sure that is",
      "DATASET...",
      1,
      std::numeric_limits<std::size_t>::max(),
      "Estimates the base mount T_B^W and the tool mount T_T^A of each dataset, 12 parameters with "
      "their covariance, and writes result.json, model.yaml and run.json to DIR/<name>/. Where the "
      "dataset states no noise, that of positions and that of orientations are estimated with the "
      "mounts. Exit status 4: there are results, but the data do not determine all 12 parameters "
      "or "
      "the solver did not converge.",
      {{"out", true, "DIR", "The results of a dataset go to DIR/<name>/."},
       {"report"},
       {"history"},
       {"operator"},
       {"model", false, {}, "A model whose effects are estimated along with base and tool."},
       {"solver"},
       {"residual"},
       {"start"},
       {"evaluation"},
       {"outliers"},
       {"loss"},
       {"loss_scale"},
       {"covariance"},
       {"noise_position"},
       {"noise_orientation"},
       {"error"},
       {"unit_magnitude"},
       {"iterations"},
       {"tolerance"},
       {"config"},
       {"threads"},
       {"json"},
       {"quiet"},
       {"force"}},
      &RunCalibrate,
      {{"hexcal calibrate examples/neurobot/dataset.yaml --out=out",
        "Base and tool from the readings of the markers."},
       {"hexcal calibrate examples/paper/dataset.yaml --solver=linearized --start=shah --out=out",
        "The same by the paper's own iteration, from a closed form."},
       {"hexcal calibrate examples/neurobot*/dataset.yaml --outliers=reject --json --out=out",
        "Several datasets, bad poses left out, the results as JSON."}},
  };
}

}  // namespace hexcal
