// SPDX-License-Identifier: BSD-3-Clause
#include "report/accuracy_charts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/chart_parts.h"
#include "report/html/escape.h"
#include "report/quantity.h"

namespace hexcal {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kMilli = 1e3;

Json Scaled(const std::vector<double>& values) {
  Json list = Json::array();
  for (const double value : values)
    list.push_back(std::isfinite(value) ? Json(kMilli * value) : Json());
  return list;
}

}  // namespace

Chart CorrelationChart(const Estimate& estimate) {
  Chart chart;
  chart.title = "Correlation of the 12 parameters";
  chart.shows =
      "how the errors of base and tool hang together: 1 and -1 always, 0 not at all (each small "
      "motion along and about the axes of its own frame).";
  chart.good =
      "pale off the diagonal. Strong pairs are not wrong: the data tell the sum of a negative "
      "pair, the "
      "difference of a positive one, better than each number alone, and the uncertainty of a point "
      "of the tool takes that into account.";
  chart.table = {{{""}}, {}};
  Json names = Json::array(), rows = Json::array();
  for (int i = 0; i < 12; ++i) {
    const std::string name(kParameters[i].name);
    names.push_back(name);
    chart.table.columns.push_back({name, true});
    Json row = Json::array();
    std::vector<std::string> texts = {name};
    for (int j = 0; j < 12; ++j) {
      const bool is_known =
          estimate.observability.determined[i] && estimate.observability.determined[j];
      const double value = estimate.covariance(i, j) /
                           std::sqrt(estimate.covariance(i, i) * estimate.covariance(j, j));
      row.push_back(is_known ? Json(value) : Json());
      texts.push_back(is_known ? fmt::format("{:.2f}", value) : "–");
    }
    rows.push_back(row);
    chart.table.rows.push_back(texts);
  }
  chart.data = Json::array({{{"type", "heatmap"},
                             {"x", names},
                             {"y", names},
                             {"z", rows},
                             {"coloraxis", "coloraxis"},
                             {"hovertemplate", "%{y}, %{x}: %{z:.2f}<extra></extra>"}}});
  Json y = OpenAxis("");
  y["autorange"] = "reversed";
  Json x = OpenAxis("");
  x["tickangle"] = -90;
  chart.layout = {
      {"height", 470}, {"xaxis", x}, {"yaxis", y}, {"coloraxis", DivergingColours(1.0, "")}};
  return chart;
}

Chart MapChart(const PointReport& report) {
  const AccuracyMap& map = report.map;
  Chart chart;
  chart.title = fmt::format("The error of {} over the workspace", report.point.name);
  chart.shows =
      "the length (mm) that the error does not exceed with 95 %, by the platform's position x (to "
      "the right) and y (up, both in mm), at three heights z (mm), each with the worst of the "
      "orientations; the colours begin at zero.";
  chart.good = "even colours; colours that deepen to one side say where to measure more poses.";
  chart.table = {{{"z, mm", true}, {"y, mm", true}}, {}};
  for (const double x : map.x)
    chart.table.columns.push_back({fmt::format("x {:.4g}", kMilli * x), true});
  const int heights = static_cast<int>(map.z.size());
  double largest = 0.0;
  for (int k = 0; k < heights; ++k) {
    Json rows = Json::array();
    for (std::size_t j = 0; j < map.y.size(); ++j) {
      rows.push_back(Scaled(map.lengths[k][j]));
      std::vector<std::string> texts = {fmt::format("{:.4g}", kMilli * map.z[k]),
                                        fmt::format("{:.4g}", kMilli * map.y[j])};
      for (const double length : map.lengths[k][j])
        if (std::isfinite(length)) largest = std::max(largest, kMilli * length);
      for (const double length : map.lengths[k][j]) texts.push_back(MilliText(length));
      chart.table.rows.push_back(texts);
    }
    chart.data.push_back({{"type", "heatmap"},
                          {"x", Scaled(map.x)},
                          {"y", Scaled(map.y)},
                          {"z", rows},
                          {"coloraxis", "coloraxis"},
                          {"xaxis", k == 0 ? "x" : fmt::format("x{}", k + 1)},
                          {"yaxis", k == 0 ? "y" : fmt::format("y{}", k + 1)},
                          {"hovertemplate", "x %{x}, y %{y}: %{z:.4f} mm<extra></extra>"}});
    // Short, for three stand side by side on a narrow screen.
    Json x = OpenAxis(fmt::format("z {:.4g}", kMilli * map.z[k]));
    x["nticks"] = 3, x["tickangle"] = 0;
    chart.layout[AxisKey("xaxis", k + 1)] = x;
    Json y = OpenAxis(k == 0 ? "y, mm" : "");
    if (k > 0) y["showticklabels"] = false;
    chart.layout[AxisKey("yaxis", k + 1)] = y;
  }
  chart.layout["grid"] = {
      {"rows", 1}, {"columns", heights}, {"pattern", "independent"}, {"xgap", 0.3}};
  chart.layout["height"] = 330;
  Json scale = Json::array();
  scale.push_back(Json::array({0.0, "@middle"}));
  scale.push_back(Json::array({1.0, "@high"}));
  chart.layout["coloraxis"] = {
      {"cmin", 0},  // which plotly heeds with a cmax alone
      {"cmax", largest > 0.0 ? largest : 1.0},
      {"colorscale", scale},
      {"colorbar", {{"title", {{"text", "mm"}}}, {"thickness", 12}, {"exponentformat", "power"}}}};
  return chart;
}

}  // namespace hexcal
