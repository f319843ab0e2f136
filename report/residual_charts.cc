// SPDX-License-Identifier: BSD-3-Clause
#include "report/residual_charts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/chart_parts.h"

namespace hexcal {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kMilli = 1e3;

Chart AxesChart(const std::vector<PoseGap>& poses, int first, const char* title, const char* unit) {
  constexpr const char* kAxes[6] = {"x", "y", "z", "about x", "about y", "about z"};
  Chart chart;
  chart.title = fmt::format("{} residuals in order of visit", title);
  chart.shows = fmt::format(
      "measured minus predicted along each axis of the tool ({}), pose by pose, before and after "
      "(hover for the pose's name).",
      unit);
  chart.good =
      "a structureless band about zero after; waves, trends, jumps or single far points mean that "
      "something is still missing.";
  const Json order = OrderOf(poses.size());
  const Json labels = LabelsOf(poses);
  for (int k = first; k < first + 3; ++k) {
    Json before = Json::array(), after = Json::array();
    for (const PoseGap& pose : poses) {
      before.push_back(kMilli * pose.before[k]);
      after.push_back(kMilli * pose.after[k]);
    }
    const int panel = k - first + 1;
    chart.data.push_back(DotTrace("before", order, before, labels, true, panel));
    chart.data.push_back(DotTrace("after", order, after, labels, false, panel));
    chart.layout[AxisKey("yaxis", panel)] = Axis(fmt::format("{}, {}", kAxes[k], unit), false);
    Json x = OpenAxis(panel == 3 ? "order of visit" : "");
    if (panel < 3) x["matches"] = "x3", x["showticklabels"] = false;
    chart.layout[AxisKey("xaxis", panel)] = x;
  }
  chart.layout["grid"] = {{"rows", 3}, {"columns", 1}, {"pattern", "independent"}, {"ygap", 0.12}};
  chart.layout["height"] = 520;
  chart.table = {{{"pose"},
                  {"before, " + std::string(kAxes[first]), true},
                  {kAxes[first + 1], true},
                  {kAxes[first + 2], true},
                  {"after, " + std::string(kAxes[first]), true},
                  {kAxes[first + 1], true},
                  {fmt::format("{}, {}", kAxes[first + 2], unit), true}},
                 {}};
  for (const PoseGap& pose : poses) {
    std::vector<std::string> row = {pose.label};
    for (const Vector6d* residual : {&pose.before, &pose.after})
      for (int k = first; k < first + 3; ++k)
        row.push_back(fmt::format("{:.4f}", kMilli * (*residual)[k]));
    chart.table.rows.push_back(row);
  }
  return chart;
}

Chart LegLengthChart(const std::vector<PoseGap>& poses) {
  Chart chart;
  chart.title = "Leg residuals against leg length";
  chart.shows =
      "by how much each leg would have to be longer to explain the difference (mm), against its "
      "reported length, before and after.";
  chart.good =
      "points about zero after. A level off zero is an offset, a slope a gain, a bend a "
      "nonlinearity, a wave a screw or encoder; one leg alone names the leg.";
  const Json labels = LabelsOf(poses);
  for (int leg = 0; leg < 6; ++leg) {
    Json length = Json::array(), before = Json::array(), after = Json::array();
    for (const PoseGap& pose : poses) {
      length.push_back(kMilli * (*pose.leg_lengths)[leg]);
      before.push_back(kMilli * pose.legs_before[leg]);
      after.push_back(kMilli * pose.legs_after[leg]);
    }
    chart.data.push_back(DotTrace("before", length, before, labels, true, leg + 1));
    chart.data.push_back(DotTrace("after", length, after, labels, false, leg + 1));
    chart.layout[AxisKey("xaxis", leg + 1)] =
        OpenAxis(fmt::format("length of leg {}, mm", leg + 1));
    Json y = Axis(leg % 2 == 0 ? "mm" : "", false);
    if (leg > 0) y["matches"] = "y";
    chart.layout[AxisKey("yaxis", leg + 1)] = y;
  }
  chart.layout["grid"] = {
      {"rows", 3}, {"columns", 2}, {"pattern", "independent"}, {"xgap", 0.18}, {"ygap", 0.35}};
  chart.layout["height"] = 640;
  return chart;
}

Chart LegMapChart(const std::vector<PoseGap>& poses) {
  Chart chart;
  chart.title = "Map of the legs' residuals";
  chart.shows =
      "the same leg residuals (mm) by leg and pose, in order of visit: above before, below after, "
      "in the same colours.";
  chart.good =
      "a faint, patternless lower map. A coloured row is one leg's own, a coloured column one "
      "pose, "
      "a "
      "change from left to right a drift.";
  Json legs = Json::array();
  for (int leg = 1; leg <= 6; ++leg) legs.push_back(fmt::format("leg {}", leg));
  double largest = 0.0;
  chart.table = {{{"pose"}}, {}};
  for (const bool is_before : {true, false}) {
    Json rows = Json::array();
    for (int leg = 0; leg < 6; ++leg) {
      Json row = Json::array();
      for (const PoseGap& pose : poses) {
        const double value = kMilli * (is_before ? pose.legs_before : pose.legs_after)[leg];
        largest = std::max(largest, std::abs(value));
        row.push_back(value);
      }
      rows.push_back(row);
      chart.table.columns.push_back(
          {fmt::format("{} {}", is_before ? "before" : "after", leg + 1), true});
    }
    const int panel = is_before ? 1 : 2;
    chart.data.push_back({{"type", "heatmap"},
                          {"x", OrderOf(poses.size())},
                          {"y", legs},
                          {"z", rows},
                          {"coloraxis", "coloraxis"},
                          {"xaxis", panel == 1 ? "x" : "x2"},
                          {"yaxis", panel == 1 ? "y" : "y2"}});
    Json y = Axis(is_before ? "before" : "after", false);
    y["autorange"] = "reversed";
    chart.layout[AxisKey("yaxis", panel)] = y;
    chart.layout[AxisKey("xaxis", panel)] = OpenAxis(is_before ? "" : "order of visit");
  }
  for (const PoseGap& pose : poses) {
    std::vector<std::string> row = {pose.label};
    for (const Vector6d* legs_of : {&pose.legs_before, &pose.legs_after})
      for (int leg = 0; leg < 6; ++leg)
        row.push_back(fmt::format("{:.4f}", kMilli * (*legs_of)[leg]));
    chart.table.rows.push_back(row);
  }
  chart.layout["grid"] = {{"rows", 2}, {"columns", 1}, {"pattern", "independent"}, {"ygap", 0.15}};
  chart.layout["height"] = 440;
  chart.layout["coloraxis"] = DivergingColours(largest, "mm");
  return chart;
}

}  // namespace

std::vector<Chart> ResidualCharts(const std::vector<PoseGap>& poses) {
  if (poses.empty()) return {};
  return {AxesChart(poses, 0, "Position", "mm"), AxesChart(poses, 3, "Orientation", "mrad")};
}

std::vector<Chart> LegCharts(const std::vector<PoseGap>& poses) {
  const bool has_legs =
      !poses.empty() && std::all_of(poses.begin(), poses.end(), [](const PoseGap& pose) {
        return pose.leg_lengths.has_value();
      });
  if (!has_legs) return {};
  return {LegLengthChart(poses), LegMapChart(poses)};
}

}  // namespace hexcal
