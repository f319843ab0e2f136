// SPDX-License-Identifier: BSD-3-Clause
#include "apps/discover.h"

#include <fmt/format.h>

#include <chrono>
#include <optional>
#include <utility>

#include "apps/dataset_files.h"
#include "apps/exit_status.h"
#include "apps/flags.h"
#include "apps/history_entry.h"
#include "apps/in_order.h"
#include "apps/message.h"
#include "apps/output_folder.h"
#include "apps/record_of.h"
#include "apps/report_page.h"
#include "apps/stage_bars.h"
#include "apps/usage_error.h"
#include "discovery/discover.h"
#include "model/machine.h"
#include "report/discovery_html.h"
#include "report/discovery_json.h"
#include "report/discovery_table.h"
#include "report/result_json.h"

namespace hexcal {
namespace {

constexpr std::string_view kDiscoveryMark = R"("format": "hexcal/discovery/)";

Discovery DiscoverWithBars(const Dataset& dataset, DiscoverOptions options) {
  StageBars bars(FLAGS_quiet);
  options.progress = [&bars](const char* stage, int done, int of) { bars.Update(stage, done, of); };
  return Discover(dataset, options);
}

ResultHeader HeaderOfModel(const Dataset& dataset) {
  const bool by_markers = dataset.measurement->kind == Measurement::Kind::kMarkers;
  return {dataset.name, "nonlinear", by_markers ? "marker" : "pose", "", ReadingsOf(dataset)};
}

std::vector<Effect> EffectsOf(const Discovery& discovery) {
  std::vector<Effect> effects;
  for (const GivenEffect& given : discovery.given) effects.push_back(given.now.effect);
  for (const DiscoveredEffect& found : discovery.effects) effects.push_back(found.effect);
  return effects;
}

// What to start from; nothing without a --model, or where that has no effects.
std::optional<Machine> OpenModel() {
  if (FLAGS_model.empty()) return std::nullopt;
  Machine model = ReadMachine(FLAGS_model);
  if (model.pose_map)
    throw UsageError(
        "--model: discover starts from effects, and a pose map is none; it finds the map anew "
        "from a model without it");
  if (model.effects.empty()) return std::nullopt;
  return model;
}

int RunDiscover(const std::vector<std::string>& files) {
  const auto start = std::chrono::steady_clock::now();
  std::optional<Machine> model = OpenModel();
  const Dataset dataset = OpenDataset(files[0], true);
  OutputFolder folder(FLAGS_out,
                      dataset.name,
                      {{"discovery.json", std::string(kDiscoveryMark)},
                       {"result.json", std::string(kResultMark)},
                       {"model.yaml", std::string(kModelMark)},
                       {"run.json", std::string(kRunMark)},
                       ReportPage("discover")},
                      InputFiles(dataset, FLAGS_model),
                      FLAGS_force);
  CheckHistoryFlag();
  DiscoverOptions options = DiscoverOptionsFromFlags();
  options.model = std::move(model);
  const Discovery discovery = DiscoverWithBars(dataset, options);
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  RunRecord record = RecordOf("discover", dataset, seconds, options.threads);
  record.inputs = InputFiles(dataset, FLAGS_model);
  const std::vector<Effect> effects = EffectsOf(discovery);
  const std::string result = ResultJson(HeaderOfModel(dataset), discovery.estimate, effects);
  HistoryEntry entry(
      "discover", dataset, record, HeaderOfModel(dataset), discovery.estimate, effects, result);
  record.history = entry.mark();
  folder.Write({{"discovery.json", DiscoveryJson(dataset.name, options, discovery)},
                {"model.yaml", WriteMachine(discovery.machine)},
                {"run.json", RunJson(record)},
                {"result.json", result},
                {"report.html",
                 DiscoveryHtml(dataset.name,
                               record,
                               discovery,
                               MakeScene(dataset, discovery),
                               ResidualsOf(dataset, discovery))}});
  entry.Append();
  PrintNewWarnings(dataset, discovery.warnings, "discovery.json");
  if (FLAGS_json && !FLAGS_quiet)
    fmt::print("{}\n", DiscoveryJsonLine(dataset.name, options, discovery));
  else if (!FLAGS_quiet)
    fmt::print(
        "{}  {:<15}{}\n\n", DiscoveryTable(dataset.name, discovery), "written to", folder.path());
  return discovery.estimate.IsTrustworthy() ? kDone : kNotTrusted;
}

}  // namespace

DiscoverOptions DiscoverOptionsFromFlags() {
  DiscoverOptions options;
  options.alpha = FLAGS_alpha;
  options.bootstraps = FLAGS_bootstraps;
  options.folds = FLAGS_folds;
  if (FLAGS_noise_position > 0)
    options.noise = NoiseLevels{FLAGS_noise_position, FLAGS_noise_orientation};
  options.seed = static_cast<std::uint64_t>(FLAGS_seed);
  options.threads = ThreadsFor(FLAGS_threads);
  return options;
}

Command DiscoverCommand() {
  return {
      "discover",
      "finds where prediction and measurement disagree, and names the missing effect",
      "DATASET",
      1,
      1,
      "Calibrates base and tool, tests what they leave against every effect of docs/effects.md "
      "that "
      "the dataset can be tested for, names the one that the data support (or the class, or says "
      "that it is unknown), adds it to the model, fits again and shows how far the gap between "
      "prediction "
      "and measurement shrinks, on poses that neither the fit nor the choice has seen. Writes "
      "report.html (open it in a browser), discovery.json, result.json, model.yaml (for predict, "
      "simulate and calibrate --model) and run.json to DIR/<name>/. No verdict changes the exit "
      "status; 4: the 12 parameters cannot be "
      "trusted.",
      {{"out", true, "DIR", "The results go to DIR/<name>/."},
       {"history"},
       {"operator"},
       {"model",
        false,
        {},
        "A model to start from: its effects are fitted along, and what is beyond them is sought."},
       {"alpha"},
       {"bootstraps"},
       {"noise_position"},
       {"noise_orientation"},
       {"folds"},
       {"seed", false, {}, "The same seed draws the same noise and the same folds."},
       {"config"},
       {"threads"},
       {"json"},
       {"quiet"},
       {"force"}},
      &RunDiscover,
      {{"hexcal discover examples/hidden-effect/dataset.yaml --bootstraps=199 --out=out",
        "What the model misses; fewer draws than usual, for a first look."}},
  };
}

}  // namespace hexcal
