// SPDX-License-Identifier: BSD-3-Clause
#include "report/discovery_charts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/chart_parts.h"
#include "report/discovery_given.h"
#include "report/discovery_words.h"
#include "report/effect_numbers.h"
#include "report/html/escape.h"
#include "report/quantity.h"

namespace hexcal {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kMilli = 1e3;
constexpr std::size_t kMostBars = 10;
constexpr std::size_t kMostSizes = 40;

// What a gap is read from: position or orientation.
struct Part {
  const char* title;
  const char* unit;
  double GapSize::*size;
};
constexpr Part kPosition = {"Position", "mm", &GapSize::rms_position};
constexpr Part kOrientation = {"Orientation", "mrad", &GapSize::rms_orientation};

Chart GapChart(const Gap& gap, const std::string& start, const Part& part) {
  const auto value = [&](const GapSize& size) {
    return IsKnown(size) ? Json(kMilli * size.*part.size) : Json();
  };
  const Json groups = Json::array({"on the data", "held out"});
  const double floor = kMilli * gap.noise_floor.*part.size;
  Chart chart;
  chart.title = fmt::format("{}: the gap before and after", part.title);
  chart.shows = fmt::format(
      "the RMS difference between prediction and measurement ({}), with {} and with what was "
      "found, on the data and on poses that neither fit nor search had seen; the line is what "
      "noise alone leaves.",
      part.unit,
      start);
  chart.good = "both blue bars at the line, the held-out one not much above the other.";
  chart.data = Json::array({{{"type", "bar"},
                             {"name", start},
                             {"x", groups},
                             {"y", Json::array({value(gap.before), value(gap.heldout_before)})},
                             {"marker", {{"color", "@before"}}}},
                            {{"type", "bar"},
                             {"name", "with what was found"},
                             {"x", groups},
                             {"y", Json::array({value(gap.after), value(gap.heldout_after)})},
                             {"marker", {{"color", "@after"}}}}});
  chart.layout = {{"height", 340},
                  {"barmode", "group"},
                  {"shapes", Json::array({Level("noise floor", floor, "@floor")})},
                  {"bargap", 0.35},
                  {"yaxis", Axis(fmt::format("RMS, {}", part.unit), true)}};
  chart.table = {{{"poses"}, {"before", true}, {"after", true}, {"noise floor", true}}, {}};
  const auto row = [&](const char* poses, const GapSize& before, const GapSize& after) {
    if (IsKnown(before))
      chart.table.rows.push_back({poses,
                                  fmt::format("{:.4g} {}", kMilli * before.*part.size, part.unit),
                                  fmt::format("{:.4g} {}", kMilli * after.*part.size, part.unit),
                                  fmt::format("{:.4g} {}", floor, part.unit)});
  };
  row("on the data", gap.before, gap.after);
  row("held out", gap.heldout_before, gap.heldout_after);
  return chart;
}

}  // namespace

std::vector<Chart> GapCharts(const Discovery& discovery) {
  const std::string start = StartOf(discovery);
  return {GapChart(discovery.gap, start, kPosition), GapChart(discovery.gap, start, kOrientation)};
}

Chart StepChart(const Discovery& discovery) {
  Json names = Json::array({discovery.given.empty() ? "base and tool" : "given"});
  Json sizes = Json::array({kMilli * discovery.gap.before.rms_position});
  Chart chart;
  chart.title = "The gap, step by step";
  chart.table = {{{"step", true},
                  {"added"},
                  {"p", true},
                  {"RMS, mm", true},
                  {"RMS, mrad", true},
                  {"chi-square", true},
                  {"degrees of freedom", true}},
                 {}};
  const auto row =
      [&](std::size_t number, const std::string& added, const std::string& p, const GapSize& size) {
        chart.table.rows.push_back({fmt::format("{}", number),
                                    added,
                                    p,
                                    MilliText(size.rms_position),
                                    MilliText(size.rms_orientation),
                                    fmt::format("{:.1f}", size.chi_square),
                                    fmt::format("{}", size.degrees_of_freedom)});
      };
  row(0, StartOf(discovery), "", discovery.gap.before);
  std::size_t number = 0;
  for (const Step& step : discovery.steps) {
    ++number;
    if (step.added.empty()) continue;
    names.push_back(fmt::format("{}. {}", number, EscapeLabel(step.added)));
    sizes.push_back(kMilli * step.after.rms_position);
    row(number, step.added, ProbabilityText(step.p_value), step.after);
  }
  const double floor = kMilli * discovery.gap.noise_floor.rms_position;
  chart.shows = "the RMS position difference on the data (mm) after each thing that was added.";
  chart.good = "a fall to the noise floor, and no step that hardly helps.";
  chart.data = Json::array({{{"type", "scatter"},
                             {"mode", "lines+markers"},
                             {"name", "on the data"},
                             {"x", names},
                             {"y", sizes},
                             {"line", {{"color", "@after"}}},
                             {"marker", {{"size", 9}}}}});
  chart.layout = {{"height", 320},
                  {"showlegend", true},
                  {"shapes", Json::array({Level("noise floor", floor, "@floor")})},
                  {"yaxis", Axis("RMS, mm", true)}};
  return chart;
}

Chart RankingChart(const Step& step, std::size_t number) {
  Chart chart;
  chart.title = step.added.empty() ? fmt::format("Step {}: nothing more is added", number)
                                   : fmt::format("Step {}: {} is added", number, step.added);
  chart.shows =
      "the evidence for each candidate against adding nothing (twice the logarithm of the Bayes "
      "factor), best first.";
  chart.good =
      "one bar far above the rest, for a name that stands alone; bars of about equal length are "
      "rivals that these data hardly tell apart. Below zero the data speak against it.";
  chart.table = {{{"candidate"}, {"evidence", true}, {"p by itself", true}}, {}, -1};
  Json names = Json::array(), scores = Json::array(), colours = Json::array();
  for (const CandidateScore& candidate : step.candidates) {
    if (chart.table.rows.size() == kMostBars) break;
    const std::string name = NameWithIndex(candidate.name, candidate.index);
    const bool is_added = chart.table.rows.empty() && candidate.name == step.added;
    const std::string p = ProbabilityText(candidate.p_value, candidate.log10_p);
    if (is_added) chart.table.chosen_row = 0;
    chart.table.rows.push_back({name, fmt::format("{:.1f}", candidate.score), p});
    // Below the name, where it has room on narrow screens too.
    names.push_back(fmt::format("{}<br><sub>p = {}</sub>", EscapeLabel(name), p));
    scores.push_back(candidate.score);
    colours.push_back(is_added ? "@chosen" : "@other");
  }
  Json x = Axis("evidence", true);
  Json y = Axis("", false);
  y["autorange"] = "reversed", y["type"] = "category", y["showgrid"] = false;
  chart.data = Json::array({{{"type", "bar"},
                             {"orientation", "h"},
                             {"x", scores},
                             {"y", names},
                             {"marker", {{"color", colours}}}}});
  chart.layout = {{"height", 110 + 44 * static_cast<int>(names.size())},
                  {"showlegend", false},
                  {"xaxis", x},
                  {"yaxis", y}};
  return chart;
}

std::vector<Chart> SizeCharts(const DiscoveredEffect& found) {
  constexpr double kNormal95 = 1.959964;
  std::vector<Chart> charts;
  for (const EffectParameter& parameter : ParametersOf(found.effect, found.labels)) {
    if (parameter.numbers.size() > kMostSizes) continue;
    std::vector<EffectNumber> carried;
    for (const EffectNumber& number : parameter.numbers)
      if (IsShown(number)) carried.push_back(number);
    const bool is_one_unit =
        std::all_of(carried.begin(), carried.end(), [&](const EffectNumber& n) {
          return n.unit == carried.front().unit;
        });
    if (carried.size() < 2 || !is_one_unit) continue;
    const DisplayUnit unit = DisplayUnitOf(carried.front().unit);
    Json parts = Json::array(), values = Json::array(), bars = Json::array();
    Chart chart;
    chart.table = {{{"of"}, {parameter.name, true}}, {}};
    for (const EffectNumber& number : carried) {
      parts.push_back(EscapeLabel(number.part));
      values.push_back(unit.factor * number.value);
      bars.push_back(std::isfinite(number.standard_deviation)
                         ? kNormal95 * unit.factor * number.standard_deviation
                         : 0.0);
      chart.table.rows.push_back(
          {number.part, QuantityText(number.value, number.standard_deviation, number.unit)});
    }
    chart.title = fmt::format("{}: {}", found.effect.name, parameter.name);
    chart.shows = fmt::format("{} ({}) with its 95 % intervals.", parameter.name, unit.name);
    chart.good = "intervals that are short beside the size; one across zero may well be nothing.";
    chart.data =
        Json::array({{{"type", "scatter"},
                      {"mode", "markers"},
                      {"x", parts},
                      {"y", values},
                      {"error_y", {{"type", "data"}, {"array", bars}, {"color", "@after"}}},
                      {"marker", {{"color", "@after"}, {"size", 9}}}}});
    chart.layout = {{"height", 300},
                    {"showlegend", false},
                    {"xaxis", {{"type", "category"}}},
                    {"yaxis", Axis(unit.name, true)}};
    charts.push_back(std::move(chart));
  }
  return charts;
}

}  // namespace hexcal
