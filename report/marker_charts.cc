// SPDX-License-Identifier: BSD-3-Clause
#include "report/marker_charts.h"

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

Chart RmsChart(const std::vector<MarkerLeftOver>& markers) {
  Chart chart;
  chart.title = "What is left over by marker";
  chart.shows =
      "the RMS of one coordinate of each marker's residuals (mm), and how much of it the noise "
      "explains.";
  chart.good =
      "bars about as high as their marks. Markers above theirs: one has moved in its body, is "
      "dirty "
      "or partly hidden (its neighbours share the misfit), or the body's shape is not as stated. "
      "All "
      "of them: the noise is larger, or the machine's model misses something.";
  chart.table = {
      {{"marker"}, {"poses", true}, {"RMS, mm", true}, {"expected, mm", true}, {"ratio", true}},
      {}};
  Json labels = Json::array(), rms = Json::array(), expected = Json::array();
  for (const MarkerLeftOver& marker : markers) {
    labels.push_back(EscapeLabel(marker.label));
    rms.push_back(kMilli * marker.rms);
    expected.push_back(kMilli * marker.expected);
    chart.table.rows.push_back(
        {marker.label,
         fmt::format("{}", marker.poses),
         MilliText(marker.rms),
         MilliText(marker.expected),
         marker.expected > 0.0 ? fmt::format("{:.2f}", marker.rms / marker.expected) : "-"});
  }
  chart.data = Json::array({{{"type", "bar"},
                             {"name", "found"},
                             {"x", labels},
                             {"y", rms},
                             {"marker", {{"color", "@after"}}}},
                            {{"type", "scatter"},
                             {"mode", "markers"},
                             {"name", "explained by noise"},
                             {"x", labels},
                             {"y", expected},
                             {"marker",
                              {{"color", "@before"},
                               {"symbol", "line-ew-open"},
                               {"size", 18},
                               {"line", {{"width", 3}}}}}}});
  Json x = OpenAxis("");
  x["type"] = "category";
  chart.layout = {{"height", 360}, {"xaxis", x}, {"yaxis", Axis("RMS, mm", true)}};
  return chart;
}

// A hue of its own for each, told apart on light and dark ground.
constexpr const char* kHues[8] = {
    "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#8a63d2", "#56b4e9", "#8c564b", "#7f7f7f"};
constexpr const char* kShapes[4] = {"circle", "diamond", "triangle-up", "square"};

// Where a marker's residual is off along one axis of the tracker.
Json AxisTrace(const MarkerLeftOver& marker, std::size_t number, int axis, std::size_t stride) {
  Json order = Json::array(), values = Json::array(), symbols = Json::array();
  for (std::size_t i = 0; i < marker.residuals.size(); i += stride) {
    symbols.push_back(marker.used[i] ? kShapes[(number / 8) % 4] : "x-thin-open");
    order.push_back(marker.pose_of_residual[i] + 1);
    values.push_back(kMilli * marker.residuals[i][axis]);
  }
  const std::string label = EscapeLabel(marker.label);
  Json trace = DotTrace(label.c_str(), order, values, Json::array(), false, axis + 1);
  trace.erase("text");
  trace["marker"] = {{"color", kHues[number % 8]}, {"symbol", symbols}, {"size", 5}};
  return trace;
}

Chart ResidualChart(const std::vector<MarkerLeftOver>& markers) {
  Chart chart;
  chart.title = "Residuals of each marker";
  chart.shows =
      "measured minus predicted of every marker along the tracker's axes (mm), in order of visit "
      "(a click on a name hides or shows that marker).";
  chart.good =
      "bands about zero, the same for all. A marker whose band is off zero is not where the body's "
      "description has it; the widest axis is the one that the tracker sees least well.";
  std::size_t count = 0;
  bool is_any_left_out = false;
  for (const MarkerLeftOver& marker : markers) {
    count += marker.residuals.size();
    is_any_left_out |= std::count(marker.used.begin(), marker.used.end(), false) > 0;
  }
  if (is_any_left_out)
    chart.shows += " A thin cross is of a pose that was left out; the table is without it.";
  const std::size_t stride = StrideOf(count);
  if (stride > 1) chart.shows += fmt::format(" One residual in {} is drawn.", stride);
  constexpr const char* kAxes[3] = {"x, mm", "y, mm", "z, mm"};
  for (int axis = 0; axis < 3; ++axis) {
    for (std::size_t k = 0; k < markers.size(); ++k)
      chart.data.push_back(AxisTrace(markers[k], k, axis, stride));
    chart.layout[AxisKey("yaxis", axis + 1)] = Axis(kAxes[axis], false);
    Json x = OpenAxis(axis == 2 ? "order of visit" : "");
    if (axis < 2) x["matches"] = "x3", x["showticklabels"] = false;
    chart.layout[AxisKey("xaxis", axis + 1)] = x;
  }
  chart.layout["grid"] = {{"rows", 3}, {"columns", 1}, {"pattern", "independent"}, {"ygap", 0.12}};
  chart.layout["height"] = 540;
  chart.table = {{{"marker"},
                  {"mean x, mm", true},
                  {"mean y, mm", true},
                  {"mean z, mm", true},
                  {"RMS x, mm", true},
                  {"RMS y, mm", true},
                  {"RMS z, mm", true}},
                 {}};
  for (const MarkerLeftOver& marker : markers) {
    Eigen::Vector3d mean = Eigen::Vector3d::Zero(), squares = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < marker.residuals.size(); ++i) {
      if (!marker.used[i]) continue;
      mean += marker.residuals[i] / marker.poses;
      squares += marker.residuals[i].cwiseAbs2() / marker.poses;
    }
    std::vector<std::string> row = {marker.label};
    for (int k = 0; k < 3; ++k) row.push_back(MilliText(mean[k]));
    for (int k = 0; k < 3; ++k) row.push_back(MilliText(std::sqrt(squares[k])));
    chart.table.rows.push_back(row);
  }
  return chart;
}

}  // namespace

void AddMarkers(const LeftOver& left, HtmlPage* page) {
  if (left.markers.empty()) return;
  page->Heading("Marker by marker");
  page->Figures({RmsChart(left.markers), ResidualChart(left.markers)});
}

}  // namespace hexcal
