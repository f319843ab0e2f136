// SPDX-License-Identifier: BSD-3-Clause
#include "apps/history.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "apps/exit_status.h"
#include "apps/flag_value.h"
#include "apps/flags.h"
#include "apps/message.h"
#include "apps/usage_error.h"
#include "config/input_error.h"
#include "config/nearest_word.h"
#include "report/history/json.h"
#include "report/history/text.h"

namespace hexcal {
namespace {

struct Opened {
  std::string path;
  std::vector<StoredRecord> rows;
  HistoryCheck check;
};

[[noreturn]] void RefuseUsage(const std::string& message) {
  throw UsageError(fmt::format("history: {}\nTry 'hexcal help history'.", message));
}

void Print(const std::string& json, const std::string& text) {
  if (FLAGS_quiet) return;
  fmt::print("{}", FLAGS_json ? json + "\n" : text);
}

void List(const Opened& history, const std::string&) {
  std::vector<StoredRecord> rows;
  for (const StoredRecord& row : history.rows)
    if (FLAGS_dataset.empty() || (row.record && row.record->dataset == FLAGS_dataset))
      rows.push_back(row);
  if (rows.empty() && !FLAGS_dataset.empty())
    throw InputError(FileLocation(history.path),
                     fmt::format("no record of dataset '{}'", FLAGS_dataset),
                     "some ('hexcal history list' shows what there is)");
  Print(HistoryListJson(history.path, rows, history.check), HistoryListText(rows));
}

void Show(const Opened& history, const std::string& number) {
  long wanted = 0;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), wanted);
  if (error != std::errc() || end != number.data() + number.size())
    RefuseUsage(fmt::format("show: found '{}', expected the number of a record", number));
  for (const StoredRecord& row : history.rows)
    if (row.number == wanted) return Print(HistoryRecordJson(row), HistoryRecordText(row));
  throw InputError(FileLocation(history.path),
                   fmt::format("no record {}", wanted),
                   fmt::format("one of its {}", history.rows.size()));
}

void Trend(const Opened& history, const std::string&) {
  const DatasetTrendOptions options = {
      FLAGS_dataset, FLAGS_since, {TrendOptions().alpha, FLAGS_baseline}};
  const std::vector<DatasetTrend> trends = TrendsOf(history.rows, options);
  if (trends.empty())
    throw InputError(
        FileLocation(history.path),
        FLAGS_dataset.empty()
            ? fmt::format("no record from {} on", FLAGS_since)
            : fmt::format("no record of dataset '{}' from {} on", FLAGS_dataset, FLAGS_since),
        "some ('hexcal history list' shows what there is)");
  Print(HistoryTrendJson(history.path, trends, options), HistoryTrendText(trends, options.chart));
}

void Verify(const Opened& history, const std::string&) {
  const std::size_t records = history.rows.size();
  Print(HistoryCheckJson(history.path, records, history.check),
        HistoryCheckText(history.path, records, history.check));
}

// A word after "history": what it takes and does.
struct Action {
  std::string_view name;
  std::size_t arguments;  // the file and what follows it
  std::vector<std::string_view> flags;
  void (*run)(const Opened& history, const std::string& second);
};

const std::vector<Action>& Actions() {
  static const std::vector<Action> actions = {
      {"list", 1, {"dataset"}, &List},
      {"show", 2, {}, &Show},
      {"trend", 1, {"dataset", "since", "baseline"}, &Trend},
      {"verify", 1, {"head"}, &Verify}};
  return actions;
}

const Action& RequireAction(const std::vector<std::string>& words) {
  std::vector<std::string_view> names;
  for (const Action& action : Actions()) names.push_back(action.name);
  const auto action = std::find_if(
      Actions().begin(), Actions().end(), [&](const Action& a) { return a.name == words[0]; });
  if (action == Actions().end()) {
    RefuseUsage(fmt::format("found '{}', expected list, show, trend or verify{}",
                            words[0],
                            DidYouMean(words[0], names)));
  }
  if (words.size() != 1 + action->arguments)
    RefuseUsage(fmt::format("{} takes {}, found {}",
                            action->name,
                            action->arguments == 1 ? "a file" : "a file and a number",
                            words.size() - 1));
  for (const char* flag : {"dataset", "since", "baseline", "head"})
    if (WasGiven(*FindFlag(flag)) &&
        std::count(action->flags.begin(), action->flags.end(), flag) == 0)
      RefuseUsage(fmt::format("{} takes no --{}", action->name, flag));
  return *action;
}

void CheckHead() {
  const bool is_hash = FLAGS_head.size() == kNoHash.size() &&
                       FLAGS_head.find_first_not_of("0123456789abcdef") == std::string::npos;
  if (!FLAGS_head.empty() && !is_hash)
    RefuseUsage(fmt::format(
        "--head: found '{}', expected the hash that a report prints, 64 digits of 0-9a-f",
        FLAGS_head));
}

int RunHistory(const std::vector<std::string>& words) {
  const Action& action = RequireAction(words);
  CheckHead();
  Opened history = {words[1], ReadHistory(words[1]), {}};
  history.check = CheckHistory(history.rows, FLAGS_head);
  action.run(history, words.size() > 2 ? words[2] : "");
  if (history.check.is_intact()) return kDone;
  PrintError(fmt::format("{}: found {} thing{} that {} not as hexcal wrote {}{}",
                         history.path,
                         history.check.problems.size(),
                         history.check.problems.size() == 1 ? "" : "s",
                         history.check.problems.size() == 1 ? "is" : "are",
                         history.check.problems.size() == 1 ? "it" : "them",
                         action.name == "verify" ? "" : " ('hexcal history verify' shows them)"));
  return kInputRefused;
}

}  // namespace

Command HistoryCommand() {
  return {
      "history",
      "the calibrations that --history has kept, their drift, and whether anybody changed them",
      "list|show|trend|verify FILE [N]",
      2,
      3,
      "Reads a history: the file to which calibrate, audit and discover append each calibration "
      "under --history=FILE.\n"
      "  list FILE: a line a record.\n"
      "  show FILE N: all of record N.\n"
      "  trend FILE: how the 12 parameters of each dataset have moved, against their uncertainty, "
      "with control limits, and which record is out of control in which parameter.\n"
      "  verify FILE: whether any record was changed, removed, inserted or reordered; with "
      "--head=HASH, which reports print, whether the end was cut off.\n"
      "Exit status 3: the file is no history, is damaged, or a record is not as it was written.",
      {{"dataset", false, "NAME", "list, trend: the records of this dataset alone."},
       {"since"},
       {"baseline"},
       {"head"},
       {"config"},
       {"json"},
       {"quiet"}},
      &RunHistory,
      {{"hexcal calibrate examples/neurobot/dataset.yaml --history=all.sqlite --out=out && "
        "hexcal history list all.sqlite",
        "Keeps a calibration, and lists what is kept."},
       {"hexcal history trend all.sqlite", "Has anything drifted, against its uncertainty?"}},
      {"list", "show", "trend", "verify"}};
}

}  // namespace hexcal
