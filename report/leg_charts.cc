// SPDX-License-Identifier: BSD-3-Clause
#include "report/leg_charts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/chart_parts.h"
#include "report/quantity.h"
#include "report/residual_charts.h"

namespace hexcal {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kMilli = 1e3;

// The lengths alone: the residuals are in the table of the map.
HtmlTable LengthTable(const PoseResiduals& residuals, const DrawnPoses& drawn) {
  HtmlTable table = {{{"pose"}}, {}};
  for (int leg = 0; leg < 6; ++leg)
    table.columns.push_back({fmt::format("length of leg {}, mm", leg + 1), true});
  for (const std::size_t i : drawn.indices) {
    table.rows.push_back({residuals.labels[i]});
    for (const double length : residuals.leg_lengths[i])
      table.rows.back().push_back(MilliText(length));
  }
  return table;
}

Chart LegLengthChart(const PoseResiduals& residuals) {
  const DrawnPoses drawn(residuals.labels);
  Chart chart;
  chart.title = "Leg residuals against leg length";
  chart.shows = fmt::format(
      "by how much each leg would have to be longer to explain the difference (mm, up), against "
      "its reported length (mm, to the right){}.{}",
      residuals.before ? ", before and after" : "",
      " The table has the lengths, that of the map below the residuals." + drawn.note +
          LeftOutNote(drawn.Of(residuals.used)));
  chart.good = fmt::format(
      "points about zero{}. A level off zero is an offset, a slope a gain, a bend a nonlinearity, "
      "a wave a screw or encoder; one leg alone names the leg.",
      residuals.before ? " after" : "");
  for (int leg = 0; leg < 6; ++leg) {
    Json length = Json::array();
    for (const std::size_t i : drawn.indices)
      length.push_back(kMilli * residuals.leg_lengths[i][leg]);
    const auto add = [&](const char* name, const std::vector<Vector6d>& legs, bool is_before) {
      Json values = Json::array();
      for (const std::size_t i : drawn.indices) values.push_back(kMilli * legs[i][leg]);
      Json trace = DotTrace(name, length, values, drawn.labels, is_before, leg + 1);
      if (!residuals.before) trace["showlegend"] = false;
      MarkLeftOut(drawn.Of(residuals.used), &trace);
      chart.data.push_back(trace);
    };
    if (residuals.before) add("before", residuals.before->legs, true);
    add("after", residuals.after.legs, false);
    // Short, for two stand side by side on a narrow screen.
    Json x = OpenAxis(fmt::format("leg {}, mm", leg + 1));
    x["nticks"] = 4, x["tickangle"] = 0;
    chart.layout[AxisKey("xaxis", leg + 1)] = x;
    Json y = Axis(leg % 2 == 0 ? "mm" : "", false);
    if (leg > 0) y["matches"] = "y";
    chart.layout[AxisKey("yaxis", leg + 1)] = y;
  }
  chart.table = LengthTable(residuals, drawn);
  chart.layout["grid"] = {
      {"rows", 3}, {"columns", 2}, {"pattern", "independent"}, {"xgap", 0.18}, {"ygap", 0.35}};
  chart.layout["height"] = 640;
  return chart;
}

double Largest(const std::vector<Vector6d>& legs) {
  double largest = 0.0;
  for (const Vector6d& pose : legs) largest = std::max(largest, pose.cwiseAbs().maxCoeff());
  return largest;
}

// One map of the picture; each column of the table beside it is a leg.
void AddMap(const std::vector<Vector6d>& legs,
            const DrawnPoses& drawn,
            const char* title,
            bool is_last,
            int panel,
            Chart* chart) {
  Json names = Json::array(), rows = Json::array();
  for (int leg = 0; leg < 6; ++leg) {
    Json row = Json::array();
    for (const std::size_t i : drawn.indices) row.push_back(kMilli * legs[i][leg]);
    rows.push_back(row);
    names.push_back(fmt::format("leg {}", leg + 1));
    chart->table.columns.push_back({fmt::format("{} {}", title, leg + 1), true});
  }
  for (std::size_t k = 0; k < drawn.indices.size(); ++k)
    for (int leg = 0; leg < 6; ++leg)
      chart->table.rows[k].push_back(MilliText(legs[drawn.indices[k]][leg]));
  chart->data.push_back({{"type", "heatmap"},
                         {"x", drawn.order},
                         {"y", names},
                         {"z", rows},
                         {"coloraxis", "coloraxis"},
                         {"xaxis", AxisKey("x", panel)},
                         {"yaxis", AxisKey("y", panel)}});
  Json y = Axis(is_last && panel == 1 ? "" : title, false);
  y["autorange"] = "reversed";
  chart->layout[AxisKey("yaxis", panel)] = y;
  chart->layout[AxisKey("xaxis", panel)] = OpenAxis(is_last ? "order of visit" : "");
}

Chart LegMapChart(const PoseResiduals& residuals) {
  const DrawnPoses drawn(residuals.labels);
  const bool has_before = residuals.before.has_value();
  Chart chart;
  chart.title = "Map of the legs' residuals";
  chart.shows = fmt::format("the same leg residuals (mm) by leg and pose, in order of visit{}.{}",
                            has_before ? ": above before, below after, in the same colours" : "",
                            drawn.note);
  chart.good = fmt::format(
      "a {} map. A coloured row is one leg's own, a coloured column one pose, a change from left "
      "to right a drift.",
      has_before ? "faint, patternless lower" : "patternless");
  chart.table = {{{"pose"}}, {}};
  for (const std::size_t i : drawn.indices) chart.table.rows.push_back({residuals.labels[i]});
  double largest = Largest(residuals.after.legs);
  if (has_before) {
    AddMap(residuals.before->legs, drawn, "before", false, 1, &chart);
    largest = std::max(largest, Largest(residuals.before->legs));
  }
  AddMap(
      residuals.after.legs, drawn, has_before ? "after" : "leg", true, has_before ? 2 : 1, &chart);
  if (has_before)
    chart.layout["grid"] = {
        {"rows", 2}, {"columns", 1}, {"pattern", "independent"}, {"ygap", 0.15}};
  chart.layout["height"] = has_before ? 440 : 300;
  chart.layout["coloraxis"] = DivergingColours(kMilli * largest, "mm");
  return chart;
}

}  // namespace

std::vector<Chart> LegCharts(const PoseResiduals& residuals) {
  if (residuals.leg_lengths.empty()) return {};
  return {LegLengthChart(residuals), LegMapChart(residuals)};
}

}  // namespace hexcal
