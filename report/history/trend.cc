// SPDX-License-Identifier: BSD-3-Clause
#include "report/history/trend.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>

namespace hexcal {
namespace {

// The whole number in text[from, from + size); nothing where there are not only digits.
std::optional<long> DigitsAt(const std::string& text, std::size_t from, std::size_t size) {
  long value = 0;
  const char* first = text.data() + from;
  const auto [end, error] = std::from_chars(first, first + size, value);
  if (error != std::errc() || end != first + size || *first == '-') return std::nullopt;
  return value;
}

// Days since 1970-01-01 in the Gregorian calendar, counted from March so that leap days come last.
long DaysSince1970(long year, long month, long day) {
  const long y = month > 2 ? year : year - 1;
  const long m = month > 2 ? month - 3 : month + 9;
  const long days_in_year = (153 * m + 2) / 5 + day - 1;
  return 365 * y + y / 4 - y / 100 + y / 400 + days_in_year - 719468;
}

DatasetTrend* TrendFor(const std::string& dataset, std::vector<DatasetTrend>* trends) {
  const auto found = std::find_if(trends->begin(), trends->end(), [&](const DatasetTrend& trend) {
    return trend.dataset == dataset;
  });
  if (found != trends->end()) return &*found;
  trends->push_back({dataset, {}, {}, {}, {}});
  return &trends->back();
}

}  // namespace

double SecondsOf(const std::string& utc) {
  constexpr std::string_view kForm = "0000-00-00T00:00:00Z";
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  if (utc.size() != kForm.size()) return kNaN;
  for (std::size_t i = 0; i < kForm.size(); ++i)
    if (kForm[i] != '0' && utc[i] != kForm[i]) return kNaN;
  const auto year = DigitsAt(utc, 0, 4), month = DigitsAt(utc, 5, 2), day = DigitsAt(utc, 8, 2),
             hour = DigitsAt(utc, 11, 2), minute = DigitsAt(utc, 14, 2),
             second = DigitsAt(utc, 17, 2);
  if (!year || !month || !day || !hour || !minute || !second) return kNaN;
  if (*month < 1 || *month > 12 || *day < 1 || *day > 31) return kNaN;
  return 86400.0 * static_cast<double>(DaysSince1970(*year, *month, *day)) +
         static_cast<double>(3600 * *hour + 60 * *minute + *second);
}

std::string WayOf(const HistoryRecord& record) {
  std::string way =
      fmt::format("{} by {}", record.solver, record.residual == "marker" ? "markers" : "poses");
  if (!record.error.empty()) way += fmt::format(" ({})", record.error);
  for (std::size_t i = 0; i < record.effects.size(); ++i)
    way += (i == 0 ? " with " : ", ") + record.effects[i];
  if (record.HasLoss()) {
    const std::string scale = record.Setting("loss_scale");
    way += fmt::format("; loss {}", record.Setting("loss"));
    if (!scale.empty() && scale != "0") way += fmt::format(" at {} sigmas", scale);
  }
  if (record.Setting("outliers") == "reject") way += "; without outliers";
  return way;
}

std::vector<DatasetTrend> TrendsOf(const std::vector<StoredRecord>& rows,
                                   const DatasetTrendOptions& options) {
  std::vector<DatasetTrend> trends;
  for (const StoredRecord& row : rows) {
    if (!row.record || row.record->number < options.since) continue;
    if (!options.dataset.empty() && row.record->dataset != options.dataset) continue;
    TrendFor(row.record->dataset, &trends)->records.push_back(*row.record);
  }
  for (DatasetTrend& trend : trends) {
    std::vector<DatedMounts> dated;
    std::map<std::string, long> number_of_readings;
    for (std::size_t i = 0; i < trend.records.size(); ++i) {
      const HistoryRecord& record = trend.records[i];
      const auto [first, is_new] =
          record.is_trusted ? number_of_readings.emplace(record.readings_sha256, record.number)
                            : std::pair(number_of_readings.end(), true);
      trend.repeats.push_back(is_new ? 0 : first->second);
      dated.push_back({SecondsOf(record.written), record.known, record.is_trusted && is_new});
      if (i > 0 && WayOf(record) != WayOf(trend.records[i - 1])) trend.made_otherwise.push_back(i);
    }
    trend.trend = TrendOf(dated, options.chart);
  }
  return trends;
}

}  // namespace hexcal
