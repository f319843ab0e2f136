// SPDX-License-Identifier: BSD-3-Clause
#include "apps/compare.h"

#include <fmt/format.h>

#include <chrono>
#include <optional>

#include "apps/calibrate_options.h"
#include "apps/dataset_files.h"
#include "apps/estimate_mounts.h"
#include "apps/exit_status.h"
#include "apps/flags.h"
#include "apps/in_order.h"
#include "apps/message.h"
#include "apps/output_folder.h"
#include "apps/record_of.h"
#include "apps/report_page.h"
#include "apps/stage_bars.h"
#include "report/compare_html.h"
#include "report/compare_json.h"
#include "report/compare_table.h"

namespace hexcal {
namespace {

constexpr std::string_view kCompareMark = R"("format": "hexcal/compare/)";

CompareOptions OptionsFromFlags() {
  CompareOptions options;
  options.calibrate = CalibrateOptionsFromFlags();
  options.folds = FLAGS_folds;
  options.draws = FLAGS_draws;
  options.starts = FLAGS_starts;
  options.seed = static_cast<std::uint64_t>(FLAGS_seed);
  options.threads = ThreadsFor(FLAGS_threads);
  return options;
}

Comparison CompareWithBars(const Dataset& dataset, CompareOptions options) {
  const std::optional<BaseAndTool> initial = InitialOf(dataset, options.calibrate);
  const Observations observations = MakeObservations(dataset);
  if (dataset.measurement->kind == Measurement::Kind::kMarkers)
    options.markers = [&dataset](const Observations& some) {
      return MakeMarkerObservations(dataset, some);
    };
  StageBars bars(FLAGS_quiet);
  options.progress = [&bars](std::string_view label, long done, long of) {
    bars.Update(label, done, of);
  };
  return Compare(observations, initial, options);
}

int RunCompare(const std::vector<std::string>& files) {
  const auto start = std::chrono::steady_clock::now();
  const Dataset dataset = OpenDataset(files[0], true);
  std::vector<OutputFile> outputs = {{"compare.json", std::string(kCompareMark)},
                                     {"run.json", std::string(kRunMark)}};
  if (FLAGS_report) outputs.push_back(ReportPage("compare"));
  OutputFolder folder(FLAGS_out, dataset.name, outputs, InputFiles(dataset, ""), FLAGS_force);
  const CompareOptions options = OptionsFromFlags();
  const Comparison comparison = CompareWithBars(dataset, options);
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  RunRecord record = RecordOf("compare", dataset, seconds, options.threads);
  record.methods = TimesOf(comparison);
  std::vector<std::pair<std::string, std::string>> results = {
      {"compare.json", CompareJson(dataset.name, options, comparison)},
      {"run.json", RunJson(record)}};
  if (FLAGS_report) {
    const Observations observations = MakeObservations(dataset);
    results.emplace_back("report.html",
                         CompareHtml(dataset.name,
                                     record,
                                     comparison,
                                     MakeScene(dataset, observations, comparison.reference),
                                     MakeLeftOver(dataset, observations, comparison.reference)));
  }
  folder.Write(results);
  PrintNewWarnings(dataset, comparison.reference.warnings, "compare.json");
  if (FLAGS_json && !FLAGS_quiet)
    fmt::print("{}\n", CompareJsonLine(dataset.name, options, comparison));
  else if (!FLAGS_quiet)
    fmt::print("{}\n  written to     {}\n\n",
               CompareTable(dataset.name, options, comparison),
               folder.path());
  return comparison.reference.IsTrustworthy() ? kDone : kNotTrusted;
}

}  // namespace

Command CompareCommand() {
  return {
      "compare",
      "the closed forms, the linearized iterations and the nonlinear solution side by side",
      "DATASET",
      1,
      1,
      "Solves the dataset by the paper's iteration, the twist iteration, Zhuang's AX = YB, Shah, "
      "Li, "
      "Park-Martin and the nonlinear problem (by pose, by marker where markers were measured, "
      "without "
      "outliers), and shows how far each is from the nonlinear solution, "
      "what it leaves over, how well it predicts poses that it has not seen, and what it costs. "
      "Says "
      "whether the nonlinear solution is proven to be the best anywhere, whether its covariance "
      "may "
      "be used (JCGM 101:2008, clause 8), and from which starts the iterations arrive. Writes "
      "compare.json and run.json, which has the times, to DIR/<name>/. Exit status 4: the "
      "nonlinear "
      "solution cannot be trusted.",
      {{"out", true, "DIR", "The results go to DIR/<name>/."},
       {"report"},
       {"start", false, {}, "Where the linearized iterations start."},
       {"noise_position"},
       {"noise_orientation"},
       {"seed", false, {}, "The same seed draws the same folds, repetitions and starts."},
       {"unit_magnitude"},
       {"iterations"},
       {"tolerance"},
       {"folds"},
       {"draws"},
       {"starts"},
       {"config"},
       {"threads"},
       {"json"},
       {"quiet"},
       {"force"}},
      &RunCompare,
      {{"hexcal compare examples/paper/dataset.yaml --out=out",
        "Every method on the paper's own example."}},
  };
}

}  // namespace hexcal
