// SPDX-License-Identifier: BSD-3-Clause
#include "report/coordinate_charts.h"

#include <fmt/format.h>

#include <cmath>

#include "config/units.h"
#include "report/chart_parts.h"

namespace hexcal {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kMilli = 1e3;
constexpr std::size_t kMostDrawn = 500;  // in each of 36 traces
constexpr const char* kNumbers[6] = {"x, mm", "y, mm", "z, mm", "rx, °", "ry, °", "rz, °"};
constexpr const char* kAxes[6] = {"x", "y", "z", "rx", "ry", "rz"};
constexpr const char* kColours[3] = {"@before", "@good", "@after"};

double Shown(const Vector6d& pose_vector, int number) {
  return number < 3 ? kMilli * pose_vector[number] : pose_vector[number] * 180.0 / kPi;
}

Json TraceOf(const PoseResiduals& residuals, int number, int axis, std::size_t stride) {
  Json x = Json::array(), y = Json::array();
  std::vector<bool> used;
  for (std::size_t i = 0; i < residuals.coordinates.size(); i += stride) {
    x.push_back(Shown(residuals.coordinates[i], number));
    y.push_back(kMilli * residuals.after.error[i][axis]);
    used.push_back(residuals.used[i]);
  }
  Json trace = DotTrace(kAxes[axis], x, y, Json::array(), false, number + 1);
  trace.erase("text");
  trace["marker"] = {{"color", kColours[axis % 3]}, {"size", 4}};
  MarkLeftOut(used, &trace);
  return trace;
}

HtmlTable CorrelationTable(const PoseResiduals& residuals, int first) {
  HtmlTable table = {{{"correlation with"}}, {}};
  for (int axis = first; axis < first + 3; ++axis) table.columns.push_back({kAxes[axis], true});
  for (int number = 0; number < 6; ++number) {
    std::vector<double> coordinate;
    for (std::size_t i = 0; i < residuals.coordinates.size(); ++i)
      if (residuals.used[i]) coordinate.push_back(residuals.coordinates[i][number]);
    std::vector<std::string> row = {kAxes[number]};
    for (int axis = first; axis < first + 3; ++axis) {
      std::vector<double> error;
      for (std::size_t i = 0; i < residuals.after.error.size(); ++i)
        if (residuals.used[i]) error.push_back(residuals.after.error[i][axis]);
      const double correlation = CorrelationOf(coordinate, error);
      row.push_back(std::isfinite(correlation) ? fmt::format("{:.2f}", correlation) : "–");
    }
    table.rows.push_back(row);
  }
  return table;
}

Chart ChartOf(const PoseResiduals& residuals, int first) {
  const bool is_position = first == 0;
  const std::size_t count = residuals.coordinates.size();
  const std::size_t stride = (count + kMostDrawn - 1) / kMostDrawn;
  Chart chart;
  chart.title = fmt::format("{} residuals against each coordinate of the pose",
                            is_position ? "Position" : "Orientation");
  chart.shows = fmt::format(
      "measured minus predicted {} the axes of the tool ({}, a colour each) against the six "
      "numbers "
      "of the pose that the robot reported, T_A^B.{} The table has their correlations.",
      is_position ? "along" : "about",
      is_position ? "mm" : "mrad",
      (stride > 1 ? fmt::format(" One pose in {} is drawn.", stride) : "") +
          LeftOutNote(residuals.used));
  chart.good =
      "bands about zero with the same width everywhere; a slope, a bow, or a fan says that an "
      "error "
      "follows that coordinate (hexcal discover looks for what does).";
  for (int number = 0; number < 6; ++number) {
    for (int axis = first; axis < first + 3; ++axis)
      chart.data.push_back(TraceOf(residuals, number, axis, stride));
    Json x = OpenAxis(kNumbers[number]);
    x["nticks"] = 5;
    chart.layout[AxisKey("xaxis", number + 1)] = x;
    Json y = Axis(number % 2 == 0 ? (is_position ? "mm" : "mrad") : "", false);
    if (number > 0) y["matches"] = "y";
    chart.layout[AxisKey("yaxis", number + 1)] = y;
  }
  chart.layout["grid"] = {
      {"rows", 3}, {"columns", 2}, {"pattern", "independent"}, {"xgap", 0.16}, {"ygap", 0.32}};
  chart.layout["height"] = 620;
  chart.table = CorrelationTable(residuals, first);
  return chart;
}

}  // namespace

double CorrelationOf(const std::vector<double>& a, const std::vector<double>& b) {
  const auto n = static_cast<double>(a.size());
  double mean_a = 0.0, mean_b = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) mean_a += a[i] / n, mean_b += b[i] / n;
  double aa = 0.0, bb = 0.0, ab = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    aa += (a[i] - mean_a) * (a[i] - mean_a);
    bb += (b[i] - mean_b) * (b[i] - mean_b);
    ab += (a[i] - mean_a) * (b[i] - mean_b);
  }
  return ab / std::sqrt(aa * bb);
}

std::vector<Chart> CoordinateCharts(const PoseResiduals& residuals) {
  if (residuals.coordinates.empty()) return {};
  return {ChartOf(residuals, 0), ChartOf(residuals, 3)};
}

}  // namespace hexcal
