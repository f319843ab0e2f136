// SPDX-License-Identifier: BSD-3-Clause
#include "report/history/change_log.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/history/text.h"
#include "report/quantity.h"

namespace hexcal {
namespace {

constexpr std::size_t kShown = 10;     // in a report
constexpr std::size_t kJudged = 1000;  // of the chart that judges this one

std::size_t FirstShown(const ChangeLog& log) {
  const std::size_t records = log.trend.records.size();
  return records > kShown ? records - kShown : 0;
}

// "base.dz +0.0120 mm, 2.3 sigma"
std::string LargestText(const TrendPoint& point) {
  if (!point.step) return "–";
  int largest = 0;
  for (int i = 1; i < 12; ++i)
    if (std::abs(point.step->sigmas[i]) > std::abs(point.step->sigmas[largest])) largest = i;
  return fmt::format("{} {:+.4f} {}, {:.1f} σ",
                     kParameters[largest].name,
                     1e3 * point.step->difference[largest],
                     kParameters[largest].is_angle ? "mrad" : "mm",
                     std::abs(point.step->sigmas[largest]));
}

}  // namespace

ChangeLog MakeChangeLog(const std::string& path, const PendingRecord& pending) {
  std::vector<StoredRecord> rows = pending.Before(kJudged);
  StoredRecord own;
  own.record = pending.record();
  rows.push_back(own);
  ChangeLog log;
  log.mark = {path, pending.record().number, pending.hash()};
  log.trend = TrendsOf(rows, {pending.record().dataset, 1, {}}).front();
  return log;
}

void AddChangeLog(const ChangeLog& log, HtmlPage* page) {
  page->Section("Change log");
  page->Paragraph(
      fmt::format("This calibration is record {} of the history {}. Its hash, the head "
                  "of the history when it was written:",
                  log.mark.number,
                  log.mark.file));
  page->Code(log.mark.head);
  HtmlTable table = {{{"record", true},
                      {"written"},
                      {"by"},
                      {"with"},
                      {"way"},
                      {"largest change"},
                      {"p of all 12", true},
                      {"control chart"}},
                     {}};
  for (std::size_t i = FirstShown(log); i < log.trend.records.size(); ++i) {
    const HistoryRecord& record = log.trend.records[i];
    const TrendPoint& point = log.trend.trend.points[i];
    table.rows.push_back({fmt::format("{}", record.number),
                          record.written,
                          TextOf(record.author),
                          record.version,
                          WayOf(record),
                          LargestText(point),
                          point.step ? ProbabilityText(point.step->p_value) : "–",
                          VerdictText(log.trend, i)});
  }
  page->Table(table);
  page->Note(
      "The records of this dataset, the last ten at most; changes are since the one before. A "
      "record holds the hash of the one "
      "before it: 'hexcal history verify FILE --head=HASH' finds whether any of them, up to this "
      "one, was changed, removed, inserted or reordered since this page was written. Control "
      "chart: each record against those before it that were in control (Shewhart's limits and "
      "chi-square of all 12, docs/history.md).");
}

nlohmann::ordered_json ChangeLogJson(const ChangeLog& log) {
  nlohmann::ordered_json records = nlohmann::ordered_json::array();
  for (std::size_t i = FirstShown(log); i < log.trend.records.size(); ++i) {
    const HistoryRecord& record = log.trend.records[i];
    const TrendPoint& point = log.trend.trend.points[i];
    records.push_back({{"record", record.number},
                       {"written", record.written},
                       {"by", TextOf(record.author)},
                       {"p_value",
                        point.step && std::isfinite(point.step->p_value)
                            ? nlohmann::ordered_json(point.step->p_value)
                            : nlohmann::ordered_json()},
                       {"in_control",
                        point.is_judged ? nlohmann::ordered_json(point.is_in_control)
                                        : nlohmann::ordered_json()}});
  }
  return {{"file", log.mark.file},
          {"record", log.mark.number},
          {"head", log.mark.head},
          {"records", records}};
}

}  // namespace hexcal
