// SPDX-License-Identifier: BSD-3-Clause
#include "report/history/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "config/utf8.h"
#include "report/quantity.h"

namespace hexcal {
namespace {

constexpr std::size_t kShortHash = 12;
constexpr double kSecondsPerDay = 86400.0;

// A terminal obeys control characters; a file must not speak to it.
std::string Plain(std::string_view text) { return WithoutControls(text, '?'); }

std::string UnitOf(int parameter) { return kParameters[parameter].is_angle ? "mrad" : "mm"; }

std::string ChartText(const DatasetTrend& trend) {
  std::string text =
      fmt::format("  {:<7} {:<20}  {:>9}  {:>9}  {:>9}\n", "record", "when", "T²", "limit", "p");
  for (std::size_t i = 0; i < trend.records.size(); ++i) {
    const TrendPoint& point = trend.trend.points[i];
    const auto number = [&](double value) {
      return point.is_judged ? fmt::format("{:.3g}", value) : std::string("–");
    };
    text += fmt::format("  {:<7} {:<20}  {:>9}  {:>9}  {:>9}  {}\n",
                        trend.records[i].number,
                        Plain(trend.records[i].written),
                        number(point.level.t_squared),
                        number(point.level.t_squared_limit),
                        point.is_judged ? ProbabilityText(point.level.p_value) : "–",
                        VerdictText(trend, i));
  }
  return text;
}

std::string ParametersText(const DatasetTrend& trend) {
  const MountTrend& all = trend.trend;
  const TrendPoint* last = nullptr;
  const KnownMounts* known = nullptr;
  for (std::size_t i = 0; i < all.points.size(); ++i)
    if (all.points[i].is_used) last = &all.points[i], known = &trend.records[i].known;
  if (last == nullptr || !last->step) return "";
  std::string text = fmt::format("\n  {:<9} {:>16} {:>10} {:>12} {:>12} {:>10} {:>20}\n",
                                 "",
                                 "since the first",
                                 "± 1 sigma",
                                 "last - centre",
                                 "limit",
                                 "between",
                                 "drift a day");
  for (int i = 0; i < 12; ++i) {
    const auto size = [](double v) { return fmt::format("{:.4f}", 1e3 * v); };
    const std::string drift =
        all.drift ? fmt::format("{:.2g} ± {:.1g}",
                                1e3 * kSecondsPerDay * all.drift->rate[i],
                                1e3 * kSecondsPerDay * all.drift->standard_deviation[i])
                  : "–";
    text += fmt::format("  {:<9} {:>16} {:>10} {:>12} {:>12} {:>10} {:>20}  {}\n",
                        kParameters[i].name,
                        size(last->position[i]),
                        size(std::sqrt(known->covariance(i, i))),
                        last->is_judged ? size(last->level.deviation[i]) : "–",
                        last->is_judged ? size(last->level.half_width[i]) : "–",
                        size(all.between[i]),
                        drift,
                        UnitOf(i));
  }
  return text;
}

std::string WordsText(const DatasetTrend& trend) {
  const MountTrend& all = trend.trend;
  std::string text;
  if (all.in_control > 1)
    text += fmt::format("  the {} records in control {} (p = {})\n",
                        all.in_control,
                        all.scatter_shows
                            ? "scatter by more than their covariances explain; that widens limits"
                            : "agree within their covariances",
                        ProbabilityText(all.homogeneity_p));
  if (all.drift)
    text += fmt::format("  a straight drift of all 12: p = {}{}\n",
                        ProbabilityText(all.drift->p_value),
                        all.drift->p_value < 0.01 ? ", there is one" : ", none shows");
  for (const std::size_t i : trend.made_otherwise)
    text += fmt::format("  record {} was made otherwise than the one before: {}\n",
                        trend.records[i].number,
                        Plain(WayOf(trend.records[i])));
  return text;
}

}  // namespace

std::string HistoryListText(const std::vector<StoredRecord>& rows) {
  std::string text;
  for (const StoredRecord& row : rows) {
    if (!row.record) {
      text += fmt::format("{:>5}  (not readable)\n", row.number);
      continue;
    }
    const HistoryRecord& record = *row.record;
    text += fmt::format("{:>5}  {:<20}  {:<20}  {:<9}  {}  {}{}\n",
                        row.number,
                        Plain(record.written),
                        Plain(record.dataset),
                        Plain(record.command),
                        Plain(row.hash.substr(0, kShortHash)),
                        Plain(TextOf(record.author)),
                        record.is_trusted ? "" : "  (not trusted)");
  }
  return text;
}

std::string HistoryRecordText(const StoredRecord& row) {
  if (!row.record) return fmt::format("record {}: not readable\n", row.number);
  const HistoryRecord& r = *row.record;
  std::string text =
      fmt::format("record {}: {} of {}\n", row.number, Plain(r.command), Plain(r.dataset));
  const auto line = [&text](std::string_view name, const std::string& value) {
    text += fmt::format("  {:<12} {}\n", name, Plain(value));
  };
  line("hash", row.hash);
  line("follows", row.previous);
  line("written", r.written);
  line("by", TextOf(r.author));
  line("with",
       r.revision.empty() ? r.version : fmt::format("{}, revision {}", r.version, r.revision));
  line("way", WayOf(r));
  line("poses", fmt::format("{}{}", r.poses, r.is_trusted ? "" : ", not trusted"));
  for (const HashedFile& file : r.inputs) line("input", file.sha256 + "  " + file.path);
  line("result.json", r.result_sha256);
  const Vector12d vector = Minus(r.known.mounts, BaseAndTool());
  text += fmt::format("\n  {:<9} {:>12}   {}\n", "", "value", "1 sigma");
  for (int i = 0; i < 12; ++i)
    text += fmt::format("  {:<9} {:>12.4f} ± {:.4f} {}\n",
                        kParameters[i].name,
                        1e3 * vector[i],
                        1e3 * std::sqrt(r.known.covariance(i, i)),
                        r.known.determined[i] ? UnitOf(i) : UnitOf(i) + " (not determined)");
  text += fmt::format("\n  noise        {} and {} a coordinate, {}\n",
                      SizeText(r.noise.position, "m"),
                      SizeText(r.noise.orientation, "rad"),
                      r.noise.estimated ? "estimated" : "as stated");
  text += fmt::format("  chi-square   {:.5g} with {} degrees of freedom{}\n",
                      r.chi_square,
                      r.degrees_of_freedom,
                      r.HasLoss() ? " (of the loss: smaller than chance makes it)" : "");
  text += fmt::format("  warnings     {}\n", r.warning_count);
  for (const std::string& warning : r.warnings) text += "    " + Plain(warning) + "\n";
  text += "  settings    ";
  for (const auto& [name, value] : r.settings)
    if (!value.empty()) text += Plain(fmt::format(" --{}={}", name, value));
  return text + "\n";
}

std::string VerdictText(const DatasetTrend& trend, std::size_t index) {
  const TrendPoint& point = trend.trend.points[index];
  if (trend.repeats[index] > 0)
    return fmt::format("left out: the readings of record {}", trend.repeats[index]);
  if (!point.is_used) return "left out: not trusted";
  if (!point.is_judged) return "starts the chart";
  return point.is_in_control ? "in control" : "OUT OF CONTROL: " + OutOfControlText(point);
}

std::string OutOfControlText(const TrendPoint& point) {
  const bool is_slow = point.level.is_in_control;
  const ChartTest& test = is_slow ? point.moving : point.level;
  std::string text;
  for (int i = 0; i < 12; ++i)
    if (test.outside[i])
      text += fmt::format("{}{} {:+.4f} {} (limit {:.4f})",
                          text.empty() ? "" : ", ",
                          kParameters[i].name,
                          1e3 * test.deviation[i],
                          UnitOf(i),
                          1e3 * test.half_width[i]);
  return (is_slow ? "by its moving mean, " : "") +
         (text.empty() ? "all 12 together, none by itself" : text);
}

std::string HistoryTrendText(const std::vector<DatasetTrend>& trends, const TrendOptions& options) {
  std::string text;
  for (const DatasetTrend& trend : trends) {
    text += fmt::format("{}: {} records\n", Plain(trend.dataset), trend.records.size());
    text += ChartText(trend) + ParametersText(trend);
    const std::string words = WordsText(trend);
    text += (words.empty() ? "" : "\n") + words + "\n";
  }
  if (trends.empty()) return text;
  return text + fmt::format(
                    "Limits: each record against those before it that were in control; {} of the "
                    "records in\ncontrol are beyond by chance (Shewhart's 3 sigma), in T² of all "
                    "12 or in any one of them,\nand as many by the moving mean.\n",
                    ShareText(options.alpha));
}

std::string HistoryCheckText(const std::string& path,
                             std::size_t records,
                             const HistoryCheck& check) {
  std::string text = fmt::format("{}: {} record{}, {}\n",
                                 path,
                                 records,
                                 records == 1 ? "" : "s",
                                 check.is_intact() ? "each as it was written" : "NOT intact");
  for (const HistoryProblem& problem : check.problems)
    text += problem.number == 0 ? fmt::format("  {}\n", problem.what)
                                : fmt::format("  record {}: {}\n", problem.number, problem.what);
  text += fmt::format("  head  {}\n", Plain(check.head));
  if (check.after_head > 0)
    text += fmt::format("  {} record{} after the head that was asked for\n",
                        check.after_head,
                        check.after_head == 1 ? "" : "s");
  return text;
}

}  // namespace hexcal
