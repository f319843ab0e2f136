// SPDX-License-Identifier: BSD-3-Clause
#include "report/audit_readings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "report/json_parts.h"
#include "report/quantity.h"

namespace hexcal {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kWorst = 5;      // that are named whether bad or not
constexpr std::size_t kMostLines = 5;  // on a terminal

// Of one marker, over the poses.
struct OfMarker {
  std::vector<double> smallest;
  double redundancy = 0.0;  // the mean

  double Median() const { return smallest[smallest.size() / 2]; }
};

std::map<std::string, OfMarker> ByMarker(const ReadingSearch& search) {
  std::map<std::string, OfMarker> markers;
  for (const ReadingCheck& check : search.checks) {
    OfMarker& marker = markers[check.marker];
    marker.smallest.push_back(check.smallest);
    marker.redundancy += check.redundancy;
  }
  for (auto& [name, marker] : markers) {
    std::sort(marker.smallest.begin(), marker.smallest.end());
    marker.redundancy /= static_cast<double>(marker.smallest.size());
  }
  return markers;
}

std::string VerdictOf(const ReadingReport& readings, const ReadingCheck& check) {
  if (!check.is_bad) return "agrees";
  return readings.is_used[check.item] ? "contradicts, used" : "contradicts, left out with its pose";
}

HtmlTable WorstTable(const ReadingReport& readings) {
  HtmlTable table = {{{"pose"},
                      {"marker"},
                      {"off, mm", true},
                      {"sigmas", true},
                      {"p", true},
                      {"would be found from, mm", true},
                      {"verdict"}},
                     {}};
  const std::size_t bad = readings.search.Bad().size();
  for (std::size_t i = 0; i < std::min(readings.worst_first.size(), std::max(bad, kWorst)); ++i) {
    const ReadingCheck& check = readings.worst_first[i];
    table.rows.push_back({readings.labels[check.item],
                          check.marker,
                          MilliText(check.held_out.norm()),
                          fmt::format("{:.2f}", std::sqrt(check.squared)),
                          ProbabilityText(check.p_value),
                          MilliText(check.smallest),
                          VerdictOf(readings, check)});
  }
  return table;
}

HtmlTable MarkerTable(const ReadingReport& readings) {
  HtmlTable table = {{{"marker"},
                      {"readings", true},
                      {"would be found from, median, mm", true},
                      {"at most, mm", true},
                      {"redundancy, mean", true}},
                     {}};
  for (const auto& [name, marker] : ByMarker(readings.search))
    table.rows.push_back({name,
                          fmt::format("{}", marker.smallest.size()),
                          MilliText(marker.Median()),
                          MilliText(marker.smallest.back()),
                          fmt::format("{:.2f}", marker.redundancy)});
  return table;
}

Json CheckObject(const ReadingReport& readings, const ReadingCheck& check) {
  return {{"pose", readings.labels[check.item]},
          {"marker", check.marker},
          {"held_out", JsonList(check.held_out)},
          {"squared_sigmas", check.squared},
          {"p_value", check.p_value},
          {"smallest_error", check.smallest},
          {"redundancy", check.redundancy},
          {"contradicts", check.is_bad},
          {"used", bool(readings.is_used[check.item])}};
}

}  // namespace

int ReadingReport::BadAndUsed() const {
  return static_cast<int>(
      std::count_if(search.checks.begin(), search.checks.end(), [this](const ReadingCheck& check) {
        return check.is_bad && is_used[check.item];
      }));
}

std::optional<ReadingReport> CheckReadings(const Dataset& dataset,
                                           const Observations& observations,
                                           const Estimate& estimate,
                                           const ReadingOptions& options) {
  if (dataset.measurement->kind != Measurement::Kind::kMarkers) return std::nullopt;
  ReadingReport readings;
  readings.options = options;
  readings.search = FindBadReadings(
      MakeMarkerObservations(dataset, observations), estimate.mounts, estimate.outliers, options);
  for (const PoseResult& pose : estimate.poses) {
    readings.labels.push_back(pose.label);
    readings.is_used.push_back(pose.weight > 0.0);
  }
  readings.worst_first = readings.search.checks;
  std::stable_sort(readings.worst_first.begin(),
                   readings.worst_first.end(),
                   [](const ReadingCheck& a, const ReadingCheck& b) {
                     return a.is_bad != b.is_bad ? a.is_bad : a.squared > b.squared;
                   });
  return readings;
}

void AddDoubtsOfReadings(const std::optional<ReadingReport>& readings,
                         std::vector<std::string>* doubts) {
  const int bad = readings ? readings->BadAndUsed() : 0;
  if (bad > 0)
    doubts->push_back(
        bad == 1
            ? std::string("a marker's reading that the others contradict was used all the same")
            : fmt::format("{} markers' readings that the others contradict were used all the same",
                          bad));
}

void AddReadings(const ReadingReport& readings, HtmlPage* page) {
  page->Heading("Readings of single markers");
  const std::size_t bad = readings.search.Bad().size();
  page->Paragraph(fmt::format(
      "Each of {} readings of a marker in a pose was compared with what all others predict for "
      "it{}. {}",
      readings.search.checks.size(),
      readings.search.unchecked == 0
          ? ""
          : fmt::format("; {} more are checked by no others", readings.search.unchecked),
      bad == 0   ? "None contradicts them (at 1 % for all readings together)."
      : bad == 1 ? "One contradicts them (at 1 % for all readings together)."
                 : fmt::format("{} contradict them (at 1 % for all readings together).", bad)));
  if (readings.search.checks.empty()) return;
  page->Table(WorstTable(readings));
  page->Note(
      "The furthest off. Off: measured less what the others predict; sigmas: the length of that "
      "in standard deviations, three coordinates together; p: that the worst of so many clean "
      "readings is as far off.");
  page->Table(MarkerTable(readings));
  page->Note(
      "Would be found from: the smallest error of a reading, along its worst direction, that this "
      "test finds with a probability of 80 % (smallest detectable error, after Baarda). "
      "Redundancy: the part of an error that shows in the residual.");
}

std::string ReadingLines(const ReadingReport& readings) {
  const std::vector<ReadingCheck> bad = readings.search.Bad();
  if (readings.search.checks.empty()) return "";
  std::string text =
      fmt::format("  readings       {} of {} single marker readings contradict the others\n",
                  bad.empty() ? "none" : fmt::format("{}", bad.size()),
                  readings.search.checks.size());
  for (std::size_t i = 0; i < std::min(bad.size(), kMostLines); ++i)
    text +=
        fmt::format("                 {}, {}\n",
                    ReadingWords(bad[i], readings.labels[bad[i].item]),
                    readings.is_used[bad[i].item] ? "used all the same" : "left out with its pose");
  if (bad.size() > kMostLines)
    text += fmt::format("                 {} more, in audit.json\n", bad.size() - kMostLines);
  return text;
}

Json JsonReadings(const ReadingReport& readings) {
  Json worst = Json::array(), bad = Json::array(), all = Json::array(), markers = Json::array();
  for (std::size_t i = 0; i < std::min(kWorst, readings.worst_first.size()); ++i)
    worst.push_back(CheckObject(readings, readings.worst_first[i]));
  for (const ReadingCheck& check : readings.search.Bad())
    bad.push_back(CheckObject(readings, check));
  for (const ReadingCheck& check : readings.search.checks)
    all.push_back(CheckObject(readings, check));
  for (const auto& [name, marker] : ByMarker(readings.search))
    markers.push_back({{"marker", name},
                       {"readings", marker.smallest.size()},
                       {"smallest_error_median", marker.Median()},
                       {"smallest_error_largest", marker.smallest.back()},
                       {"redundancy", marker.redundancy}});
  return {{"alpha", readings.options.alpha},
          {"power", readings.options.power},
          {"checked", readings.search.checks.size()},
          {"unchecked", readings.search.unchecked},
          {"noise", readings.search.basis == NoiseBasis::kStated ? "stated" : "scaled"},
          {"contradicting", bad},
          {"worst", worst},
          {"markers", markers},
          {"all", all}};
}

}  // namespace hexcal
