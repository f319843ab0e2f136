// SPDX-License-Identifier: BSD-3-Clause
#include "report/distribution_charts.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "config/units.h"
#include "estimator/autocorrelation.h"
#include "estimator/normal_plot.h"
#include "report/chart_parts.h"

namespace hexcal {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMostPoints = 600, kMostLags = 20;

// Residuals that are looked at together.
struct Series {
  const char* name;
  const char* colour;
  std::vector<Eigen::VectorXd> rows;  // one a pose
  std::vector<double> values;         // those that are known
};

Series SeriesOf(const char* name,
                const char* colour,
                const std::vector<Vector6d>& standard,
                int first,
                int size) {
  Series series{name, colour, {}, {}};
  for (const Vector6d& pose : standard) {
    series.rows.emplace_back(pose.segment(first, size));
    for (const double x : series.rows.back())
      if (std::isfinite(x)) series.values.push_back(x);
  }
  return series;
}

// Before and after; where there is but one state, positions and orientations apart.
std::vector<Series> AllSeries(const PoseResiduals& residuals) {
  if (residuals.before)
    return {SeriesOf("before", "@before", residuals.before->standard, 0, 6),
            SeriesOf("after", "@after", residuals.after.standard, 0, 6)};
  return {SeriesOf("positions", "@after", residuals.after.standard, 0, 3),
          SeriesOf("orientations", "@before", residuals.after.standard, 3, 3)};
}

std::string WordsOf(const PoseResiduals& residuals) {
  return residuals.before ? "before and after what was found, in standard deviations of the noise "
                            "that was found"
                          : "positions and orientations apart, in standard deviations";
}

Chart HistogramChart(const PoseResiduals& residuals, const std::vector<Series>& all) {
  constexpr double kWidth = 0.5, kEnd = 4.0;
  constexpr int kSteps = 80;  // of the line
  constexpr int kBins = static_cast<int>(2.0 * kEnd / kWidth);
  Chart chart;
  chart.title = "Residuals in standard deviations of the noise";
  chart.shows = fmt::format(
      "how often residuals of each size occur, {} (each by its own noise, less what the fit takes "
      "of it; the first and the last bar hold all beyond); the line is the normal distribution.",
      WordsOf(residuals));
  chart.good = fmt::format(
      "bars{} along the line. Narrower: the noise is smaller than taken; wider: larger, or the "
      "model misses something; single bars at the ends: outliers.",
      residuals.before ? " of after" : "");
  chart.table.columns = {{"from, sigmas", true}};
  Json middles = Json::array();
  for (int bin = 0; bin < kBins; ++bin) {
    middles.push_back(-kEnd + kWidth * (bin + 0.5));
    chart.table.rows.push_back({fmt::format("{:.1f}", -kEnd + kWidth * bin)});
  }
  for (const Series& series : all) {
    std::array<int, kBins> counts{};
    for (const double x : series.values)
      ++counts[static_cast<std::size_t>(
          std::clamp(std::floor((x + kEnd) / kWidth), 0.0, kBins - 1.0))];
    chart.table.columns.push_back({series.name, true});
    for (int bin = 0; bin < kBins; ++bin)
      chart.table.rows[bin].push_back(fmt::format("{}", counts[bin]));
    chart.data.push_back({{"type", "bar"},
                          {"name", series.name},
                          {"x", middles},
                          {"y", counts},
                          {"marker", {{"color", series.colour}}}});
  }
  const auto count = static_cast<double>(all.back().values.size());
  chart.table.columns.push_back({"ideal", true});
  const auto below = [](double x) { return 0.5 * std::erfc(-x / std::sqrt(2.0)); };
  for (int bin = 0; bin < kBins; ++bin) {
    const double low = bin == 0 ? 0.0 : below(-kEnd + kWidth * bin);
    const double high = bin == kBins - 1 ? 1.0 : below(-kEnd + kWidth * (bin + 1));
    chart.table.rows[bin].push_back(fmt::format("{:.1f}", count * (high - low)));
  }
  Json sizes = Json::array(), ideal = Json::array();
  for (int i = 0; i <= kSteps; ++i) {
    const double x = kEnd * (2.0 * i / kSteps - 1.0);
    sizes.push_back(x);
    ideal.push_back(count * kWidth * std::exp(-0.5 * x * x) / std::sqrt(2.0 * kPi));
  }
  chart.data.push_back({{"type", "scatter"},
                        {"mode", "lines"},
                        {"name", "normal distribution"},
                        {"x", sizes},
                        {"y", ideal},
                        {"line", {{"color", "@floor"}, {"width", 2}}}});
  chart.layout = {{"height", 380},
                  {"barmode", "group"},
                  {"xaxis", OpenAxis("standard deviations")},
                  {"yaxis", Axis("residuals", true)}};
  return chart;
}

Json LineTrace(const char* name, const Json& x, const Json& y, const char* dash) {
  return {{"type", "scatter"},
          {"mode", "lines"},
          {"name", name},
          {"legendgroup", name},
          {"x", x},
          {"y", y},
          {"line", {{"color", "@floor"}, {"width", 1.5}, {"dash", dash}}}};
}

Chart NormalPlotChart(const PoseResiduals& residuals, const std::vector<Series>& all) {
  Chart chart;
  chart.title = "Residuals against those of a normal sample (Q-Q)";
  chart.shows = fmt::format(
      "the residuals sorted, {}, against what a normal sample of as many has at the same place "
      "(its median); between the dashed lines each stays with 95 %.{}",
      WordsOf(residuals),
      residuals.before ? " Those of before may leave the picture." : "");
  chart.good = fmt::format(
      "points{} on the straight line, 19 of 20 between the dashed ones (neighbours leave them "
      "together). A steeper line: more noise than taken; ends that bend away from it: heavier "
      "tails, or outliers; a shift: something constant is missing.",
      residuals.before ? " of after" : "");
  chart.table.columns = {
      {"residuals"}, {"rank", true}, {"residual", true}, {"normal", true}, {"95 %", true}};
  double reach = 3.0;
  for (const Series& series : all) {
    const bool is_last = &series == &all.back();
    const std::vector<NormalPlotPoint> points = NormalPlot(series.values, kMostPoints);
    Json expected = Json::array(), values = Json::array(), low = Json::array(),
         high = Json::array();
    for (const NormalPlotPoint& p : points) {
      expected.push_back(p.expected), values.push_back(p.value);
      low.push_back(p.low), high.push_back(p.high);
      if (is_last || !residuals.before)
        reach = std::max({reach, std::abs(p.value), std::abs(p.low), std::abs(p.high)});
      chart.table.rows.push_back({series.name,
                                  fmt::format("{}", p.rank),
                                  fmt::format("{:.3f}", p.value),
                                  fmt::format("{:.3f}", p.expected),
                                  fmt::format("{:.3f} to {:.3f}", p.low, p.high)});
    }
    Json trace = DotTrace(series.name, expected, values, Json::array(), false, 1);
    trace.erase("text");
    trace["marker"] = {{"color", series.colour}, {"size", 4}};
    chart.data.push_back(trace);
    if (!is_last || points.empty()) continue;
    chart.data.push_back(LineTrace("normal", expected, expected, "solid"));
    chart.data.push_back(LineTrace("95 %", expected, low, "dash"));
    chart.data.push_back(LineTrace("95 %", expected, high, "dash"));
    chart.data.back()["showlegend"] = false;
  }
  Json y = OpenAxis("standard deviations");
  y["range"] = Json::array({-1.05 * reach, 1.05 * reach});
  chart.layout = {{"height", 380}, {"xaxis", OpenAxis("of a normal sample")}, {"yaxis", y}};
  return chart;
}

Chart AutocorrelationChart(const PoseResiduals& residuals, const std::vector<Series>& all) {
  Chart chart;
  chart.title = "Likeness of neighbours in the order of visit";
  chart.shows = fmt::format(
      "the autocorrelation of the residuals, {}, from each pose to the next, the next but one and "
      "so on (mean over the axes), and what numbers without any order keep within with 95 % "
      "(± 2/√n).",
      WordsOf(residuals));
  chart.good = fmt::format(
      "bars{} within the band but for one in twenty. A slow fall from a high first bar: a drift, "
      "or something that changes slowly from pose to pose; a wave: something periodic.",
      residuals.before ? " of after" : "");
  chart.table.columns = {{"poses apart", true}};
  double band = 0.0;
  for (const Series& series : all) {
    const Autocorrelation found = FindAutocorrelation(
        series.rows, std::min(kMostLags, std::max<std::size_t>(1, series.rows.size() / 4)));
    chart.table.columns.push_back({series.name, true});
    Json lags = Json::array();
    for (std::size_t lag = 1; lag <= found.of_lag.size(); ++lag) {
      lags.push_back(lag);
      if (chart.table.rows.size() < lag) chart.table.rows.push_back({fmt::format("{}", lag)});
      chart.table.rows[lag - 1].resize(chart.table.columns.size() - 1);
      chart.table.rows[lag - 1].push_back(fmt::format("{:.3f}", found.of_lag[lag - 1]));
    }
    chart.data.push_back({{"type", "bar"},
                          {"name", series.name},
                          {"x", lags},
                          {"y", found.of_lag},
                          {"marker", {{"color", series.colour}}}});
    band = std::max(band, found.band);
  }
  chart.table.columns.push_back({"band", true});
  for (std::vector<std::string>& row : chart.table.rows) {
    row.resize(chart.table.columns.size() - 1);
    row.push_back(fmt::format("± {:.3f}", band));
  }
  Json upper = Level("95 %", band, "@floor"), lower = Level("95 %", -band, "@floor");
  lower["showlegend"] = false;
  Json x = OpenAxis("poses apart");
  x["dtick"] = chart.table.rows.size() > 10 ? 5 : 1;
  chart.layout = {{"height", 340},
                  {"barmode", "group"},
                  {"shapes", Json::array({upper, lower})},
                  {"xaxis", x},
                  {"yaxis", Axis("autocorrelation", true)}};
  return chart;
}

}  // namespace

std::vector<Chart> DistributionCharts(const PoseResiduals& residuals) {
  const std::vector<Series> all = AllSeries(residuals);
  if (all.back().values.empty()) return {};
  return {HistogramChart(residuals, all),
          NormalPlotChart(residuals, all),
          AutocorrelationChart(residuals, all)};
}

}  // namespace hexcal
