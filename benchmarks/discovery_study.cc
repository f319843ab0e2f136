// SPDX-License-Identifier: BSD-3-Clause
// How often discovery names what was hidden, and how often it names something where nothing was:
// docs/discovery.md has the tables that this prints.
//   discovery_study --cells=naming,clean,regimes,pairs,unlisted,gauges --threads=2

#include <fmt/format.h>
#include <gflags/gflags.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <thread>

#include "hidden/tally.h"

DEFINE_string(cells, "naming,clean,regimes,pairs,unlisted,gauges", "what to measure");
DEFINE_string(snr, "8,12,20", "of naming, one table a number");
DEFINE_int32(sets, 100, "a cell; of naming, rounded up to whole rounds of all effects");
DEFINE_int32(clean_sets, 2000, "without an effect, white noise");
DEFINE_int32(regime_sets, 300, "without an effect, in each other regime");
DEFINE_int32(bootstraps, 199, "of one discovery");
DEFINE_int32(folds, 0, "of one discovery; the study has held-out poses of its own, so 0: none");
DEFINE_int32(threads, 2, "datasets at a time");
DEFINE_uint64(seed, 1, "of the series");
DEFINE_uint64(first, 0, "number of the first case");
DEFINE_string(kind, "", "of naming: one effect in place of all");
DEFINE_bool(detailed, false, "physics beyond the names' own forms: harmonic, lag, unequal legs");
DEFINE_string(json, "", "file for every trial, one a line");

namespace hexcal::hidden {
namespace {

std::vector<std::string> Split(const std::string& text) {
  std::vector<std::string> parts;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, ',');) parts.push_back(part);
  return parts;
}

struct Cell {
  std::string name;
  CaseOptions options;
  int sets = 0;
  bool as_poses = false;
};

Trial RunOne(const Cell& cell, std::uint64_t number) {
  DiscoverOptions options;
  options.bootstraps = FLAGS_bootstraps;
  options.folds = FLAGS_folds;
  options.seed = FLAGS_seed + number;
  try {
    return RunTrial(cell.name, MakeCase(cell.options, FLAGS_seed, number), options, cell.as_poses);
  } catch (const std::exception& error) {
    Trial trial;
    trial.cell = cell.name;
    trial.error = error.what();
    return trial;
  }
}

std::vector<Trial> Run(const Cell& cell) {
  std::vector<Trial> trials(cell.sets);
  std::atomic<int> next = 0, done = 0;
  const auto work = [&] {
    for (int i = next++; i < cell.sets; i = next++) {
      trials[i] = RunOne(cell, FLAGS_first + i);
      std::fprintf(stderr, "\r%s %d/%d ", cell.name.c_str(), ++done, cell.sets);
    }
  };
  std::vector<std::thread> threads;
  for (int t = 1; t < FLAGS_threads; ++t) threads.emplace_back(work);
  work();
  for (std::thread& thread : threads) thread.join();
  std::fprintf(stderr, "\n");
  if (!FLAGS_json.empty()) {
    std::ofstream out(FLAGS_json, std::ios::app);
    for (const Trial& trial : trials) out << AsJson(trial).dump() << "\n";
  }
  return trials;
}

// Without a dataset that discovery refused, which is counted apart.
std::vector<Trial> Answered(const std::vector<Trial>& trials) {
  std::vector<Trial> answered;
  for (const Trial& trial : trials) {
    if (trial.error.empty())
      answered.push_back(trial);
    else
      fmt::print("failed: {} {}: {}\n", trial.cell, trial.name, trial.error);
  }
  return answered;
}

void PrintShare(const char* what, const Share& share) {
  fmt::print("| {} | {} |\n", what, Text(share));
}

// Gap closed, harm and time: of any trials.
void PrintGap(const std::vector<Trial>& trials) {
  std::vector<double> closed, seconds;
  for (const Trial& trial : trials) {
    closed.push_back(trial.GapClosed());
    seconds.push_back(trial.seconds);
  }
  fmt::print(
      "| held-out gap closed, of a refit's that knows the effect: median, 10th percentile "
      "| {:.1f} %, {:.1f} % |\n",
      100 * Quantile(closed, 0.5),
      100 * Quantile(closed, 0.1));
  PrintShare("held out more than 2 % worse than without, against the truth",
             Count(trials, [](const Trial& t) { return t.IsWorse(); }));
  PrintShare("the same against readings with their noise",
             Count(trials, [](const Trial& t) { return t.IsWorseAsMeasured(); }));
  PrintShare(
      "against the truth, than without and than a refit that knows the effect",
      Count(trials, [](const Trial& t) { return t.after > 1.02 * std::max(t.before, t.oracle); }));
  fmt::print("| processor seconds: median, 99th percentile, longest | {:.2f}, {:.2f}, {:.2f} |\n",
             Quantile(seconds, 0.5),
             Quantile(seconds, 0.99),
             Quantile(seconds, 1.0));
}

void PrintNaming(const Cell& cell) {
  const std::vector<Trial> trials = Answered(Run(cell));
  const auto has_one_carrier = [](const Trial& t) { return t.carriers.size() == 1; };
  const auto named_with_carrier = [&](const Trial& t) {
    return has_one_carrier(t) && t.NamesFirst();
  };
  fmt::print("\n## {}\n\n| | |\n| --- | --- |\n", cell.name);
  PrintShare("something found", Count(trials, [](const Trial& t) { return !t.found.empty(); }));
  PrintShare("named first", Count(trials, [](const Trial& t) { return t.NamesFirst(); }));
  PrintShare("right or in the class",
             Count(trials, [](const Trial& t) { return t.ClassIsRight(); }));
  PrintShare("this name and no other",
             Count(trials, [](const Trial& t) { return t.SetIsExact(); }));
  PrintShare("a wrong one added", Count(trials, [](const Trial& t) { return t.AddsWrong(); }));
  PrintShare("called unknown", Count(trials, [](const Trial& t) {
               return !t.found.empty() && t.found[0].name == "unknown";
             }));
  PrintShare("carrier right, where named",
             Count(
                 trials, [](const Trial& t) { return t.HasCarrier(); }, named_with_carrier));
  PrintShare("carrier right and alone, where named",
             Count(
                 trials, [](const Trial& t) { return t.HasCarrierAlone(); }, named_with_carrier));
  PrintGap(trials);
  fmt::print("\n{}", ConfusionTable(trials));
}

void PrintClean(const Cell& cell) {
  const std::vector<Trial> trials = Answered(Run(cell));
  const auto p_below = [&](double p) {
    return 100 * Count(trials, [p](const Trial& t) { return t.first_p <= p; }).Value();
  };
  fmt::print("| {} | {} | {} | {:.1f}, {:.1f}, {:.1f} | {} |\n",
             cell.name,
             Text(Count(trials, [](const Trial& t) { return !t.found.empty(); })),
             Text(Count(trials, [](const Trial& t) { return t.IsAlarm(); })),
             p_below(0.05),
             p_below(0.2),
             p_below(0.5),
             Text(Count(trials, [](const Trial& t) { return t.IsWorse(); })));
  std::fflush(stdout);
}

void PrintPairs(const Cell& cell) {
  const std::vector<Trial> trials = Answered(Run(cell));
  fmt::print("\n## {}\n\n| | |\n| --- | --- |\n", cell.name);
  PrintShare("exact set", Count(trials, [](const Trial& t) { return t.SetIsExact(); }));
  PrintShare("two names, both in their classes",
             Count(trials, [](const Trial& t) { return t.SetIsInClasses(); }));
  PrintShare("a wrong one added", Count(trials, [](const Trial& t) { return t.AddsWrong(); }));
  PrintGap(trials);
}

void PrintUnlisted(const Cell& cell) {
  const std::vector<Trial> trials = Answered(Run(cell));
  fmt::print("\n## {}\n\n| | |\n| --- | --- |\n", cell.name);
  PrintShare("unknown, or of the right site",
             Count(trials, [](const Trial& t) { return t.IsUnknownOrRightSite(); }));
  PrintShare("one wrong name, confidently",
             Count(trials, [](const Trial& t) { return t.IsConfidentlyWrong(); }));
  PrintShare("a wrong name or class", Count(trials, [](const Trial& t) { return t.IsWrong(); }));
  PrintShare("any single name", Count(trials, [](const Trial& t) {
               return !t.found.empty() && t.found[0].name != "unknown" &&
                      t.found[0].could_also_be.empty();
             }));
  PrintGap(trials);
  fmt::print("\n{}", ConfusionTable(trials));
}

// Where no data can tell two effects apart, a single name is wrong even if it is the true one.
void PrintGauge(const Cell& cell) {
  const std::vector<Trial> trials = Answered(Run(cell));
  fmt::print("\n## {}\n\n| | |\n| --- | --- |\n", cell.name);
  PrintShare("something found", Count(trials, [](const Trial& t) { return !t.found.empty(); }));
  PrintShare("right or in the class",
             Count(trials, [](const Trial& t) { return t.ClassIsRight(); }));
  PrintShare("given a single name", Count(trials, [](const Trial& t) {
               return t.NamesFirst() && t.found[0].could_also_be.empty();
             }));
  fmt::print("\n{}", ConfusionTable(trials));
}

int WholeRounds(int sets) {
  const int size = static_cast<int>(ListedEffects().size());
  return (sets + size - 1) / size * size;
}

void RunCells() {
  CaseOptions plain;
  if (FLAGS_detailed) plain.detail = Detailed();
  const auto kind = [&](const std::string& name, double snr) {
    CaseOptions options = plain;
    options.kind = name;
    options.snr = snr;
    return options;
  };
  for (const std::string& cell : Split(FLAGS_cells)) {
    if (cell == "naming")
      for (const std::string& snr : Split(FLAGS_snr))
        PrintNaming({"naming at " + snr,
                     kind(FLAGS_kind.empty() ? "any" : FLAGS_kind, std::stod(snr)),
                     FLAGS_kind.empty() ? WholeRounds(FLAGS_sets) : FLAGS_sets});
    if (cell == "pairs") PrintPairs({"two at 12", kind("pair", 12), FLAGS_sets});
    if (cell == "unlisted")
      PrintUnlisted({"outside the library at 10", kind("unlisted", 10), FLAGS_sets});
    if (cell == "gauges")
      for (const char* name : {"tracker_scale", "base_drift"}) {
        CaseOptions options = kind(name, 20);
        options.level = Level::kPoses;
        options.scene.is_static = true;
        PrintGauge({std::string("kind poses, ") + name, options, FLAGS_sets, true});
      }
    if (cell != "clean" && cell != "regimes") continue;
    fmt::print(
        "\n| {} | something found | verdict not `agrees` | p of the first search at most "
        "5 %, 20 %, 50 % | 2 % worse |\n| --- | --- | --- | --- | --- |\n",
        cell);
    for (const auto& [regime, name] : Regimes()) {
      if ((regime == Regime::kWhite) != (cell == "clean")) continue;
      CaseOptions options = kind("clean", 0);
      options.regime = regime;
      PrintClean({name, options, cell == "clean" ? FLAGS_clean_sets : FLAGS_regime_sets});
    }
  }
}

}  // namespace
}  // namespace hexcal::hidden

int main(int argc, char** argv) {
  gflags::ParseCommandLineFlags(&argc, &argv, true);
  hexcal::hidden::RunCells();
  return 0;
}
