// SPDX-License-Identifier: BSD-3-Clause
#include "report/pivot_charts.h"

#include <fmt/format.h>
#include <glog/logging.h>

#include <algorithm>
#include <array>

#include "config/units.h"
#include "estimator/quantiles.h"
#include "report/chart_parts.h"
#include "report/html/escape.h"
#include "report/quantity.h"
#include "report/space_parts.h"

namespace hexcal {
namespace {

using Json = nlohmann::ordered_json;
using Points = std::vector<Eigen::Vector3d>;

constexpr double kMilli = 1e3;
constexpr double kDegrees = 180.0 / kPi;
constexpr double kMissPart = 0.1;  // of the longest miss, in the tool's length

const char* UseOf(const PivotRow& row) { return row.used ? "used" : "left out"; }

// Values of the rows that were used, or of those that were not, and their numbers and labels.
struct Part {
  Json order = Json::array(), labels = Json::array();
  std::vector<std::size_t> rows;
};

Part PartOf(const PivotResult& result, bool used) {
  Part part;
  for (std::size_t i = 0; i < result.rows.size(); i += StrideOf(result.rows.size())) {
    if (result.rows[i].used != used) continue;
    part.order.push_back(i + 1);
    part.labels.push_back(EscapeLabel(result.rows[i].label));
    part.rows.push_back(i);
  }
  return part;
}

template <typename Value>
void AddDots(const PivotResult& result, int panel, const Value& value, Chart* chart) {
  for (const bool used : {true, false}) {
    const Part part = PartOf(result, used);
    if (part.rows.empty()) continue;
    Json values = Json::array();
    for (const std::size_t i : part.rows) values.push_back(value(result.rows[i]));
    chart->data.push_back(
        DotTrace(used ? "used" : "left out", part.order, values, part.labels, !used, panel));
  }
}

}  // namespace

Chart PivotSceneChart(const PivotPoses& poses, const PivotResult& result) {
  CHECK_EQ(poses.items.size(), result.rows.size());
  double longest = 0.0;
  for (const PivotRow& row : result.rows) longest = std::max(longest, row.residual.norm());
  const double factor = RoundFactor(kMissPart * result.x.tip_in_tool.norm() / longest);
  std::array<Points, 2> places, sticks;  // used, left out
  std::array<Json, 2> labels = {Json::array(), Json::array()};
  const std::size_t stride = StrideOf(result.rows.size());
  for (std::size_t i = 0; i < result.rows.size(); i += stride) {
    const std::size_t part = result.rows[i].used ? 0 : 1;
    const Eigen::Vector3d& place = poses.items[i].world_from_tool.translation;
    places[part].push_back(place);
    sticks[part].push_back(place);
    sticks[part].push_back(result.x.pivot_in_world + factor * result.rows[i].residual);
    labels[part].push_back(EscapeLabel(result.rows[i].label));
  }
  Chart chart;
  chart.is_in_space = true;
  chart.title = "The pivoting, in space";
  chart.shows = fmt::format(
      "the origins of frame T as measured (mm, frame W), each tied to where it puts the tip, whose "
      "miss of the pivot is {} times enlarged; the pivot, where the tip rested.",
      factor);
  chart.good =
      "origins spread over a cap about the pivot, to all sides and with some twist, and ties that "
      "meet in one small cloud. Origins along one line say that the tool was tilted about one axis "
      "alone; a tie that ends far off is a reading that went wrong.";
  constexpr const char* kNames[2] = {"used", "left out"};
  constexpr const char* kColours[2] = {"@after", "@before"};
  for (int part = 0; part < 2; ++part) {
    if (places[part].empty()) continue;
    Json origins = SpaceTrace(kNames[part], "markers", places[part], 0, kColours[part]);
    origins["text"] = labels[part], origins["hoverinfo"] = "text";
    chart.data.push_back(origins);
    Json ties =
        SpaceTrace(kNames[part], "lines", sticks[part], 2, part == 0 ? "@other" : kColours[part]);
    ties["showlegend"] = false, ties["line"]["width"] = 2;
    chart.data.push_back(ties);
  }
  Json pivot = SpaceTrace("pivot", "markers", {result.x.pivot_in_world}, 0, "@ink");
  pivot["marker"]["size"] = 6;
  chart.data.push_back(pivot);
  chart.layout = SpaceLayout(chart.data);
  chart.table = {{{"reading"}, {"x, mm", true}, {"y, mm", true}, {"z, mm", true}, {""}}, {}};
  for (std::size_t i = 0; i < result.rows.size(); i += stride) {
    std::vector<std::string> row = {result.rows[i].label};
    for (const double x : poses.items[i].world_from_tool.translation)
      row.push_back(fmt::format("{:.3f}", kMilli * x));
    row.emplace_back(UseOf(result.rows[i]));
    chart.table.rows.push_back(row);
  }
  return chart;
}

Chart PivotResidualChart(const PivotResult& result) {
  constexpr const char* kAxes[3] = {"x, mm", "y, mm", "z, mm"};
  Chart chart;
  chart.title = "What is left over, reading by reading";
  chart.shows =
      "where each reading puts the tip, less the pivot, along the axes of frame W (mm), in order "
      "(hover for the reading's name).";
  chart.good =
      "a structureless band about zero. A trend or a jump says that the tip slipped or the tool "
      "bent; single far points are readings that went wrong.";
  for (int k = 0; k < 3; ++k) {
    AddDots(
        result, k + 1, [k](const PivotRow& row) { return kMilli * row.residual[k]; }, &chart);
    chart.layout[AxisKey("yaxis", k + 1)] = Axis(kAxes[k], false);
    Json x = OpenAxis(k == 2 ? "order of reading" : "");
    if (k < 2) x["matches"] = "x3", x["showticklabels"] = false;
    chart.layout[AxisKey("xaxis", k + 1)] = x;
  }
  chart.layout["grid"] = {{"rows", 3}, {"columns", 1}, {"pattern", "independent"}, {"ygap", 0.12}};
  chart.layout["height"] = 500;
  chart.table = {{{"reading"}, {"x, mm", true}, {"y, mm", true}, {"z, mm", true}, {""}}, {}};
  for (std::size_t i = 0; i < result.rows.size(); i += StrideOf(result.rows.size())) {
    std::vector<std::string> row = {result.rows[i].label};
    for (const double x : result.rows[i].residual) row.push_back(MilliText(x));
    row.emplace_back(UseOf(result.rows[i]));
    chart.table.rows.push_back(row);
  }
  return chart;
}

Chart PivotSigmasChart(const PivotResult& result) {
  Chart chart;
  chart.title = "Each reading by its own noise";
  chart.shows =
      "how far each reading puts the tip from the pivot, in squared standard deviations (3 "
      "expected), and the limit for 95 % of the readings.";
  chart.good = "one dot in twenty above the line, none far above it but what was left out.";
  AddDots(
      result, 1, [](const PivotRow& row) { return row.squared_sigmas; }, &chart);
  std::vector<double> all;  // what was left out may be far off
  for (const PivotRow& row : result.rows) all.push_back(row.squared_sigmas);
  chart.layout = {{"height", 500},
                  {"shapes", Json::array({Level("95 %", ChiSquareQuantile(0.95, 3.0), "@floor")})},
                  {"xaxis", OpenAxis("order of reading")},
                  {"yaxis", LogAxis("squared sigmas", all)}};
  chart.table = {{{"reading"}, {"squared sigmas", true}, {""}}, {}};
  for (std::size_t i = 0; i < result.rows.size(); i += StrideOf(result.rows.size()))
    chart.table.rows.push_back({result.rows[i].label,
                                fmt::format("{:.2f}", result.rows[i].squared_sigmas),
                                UseOf(result.rows[i])});
  return chart;
}

Chart TiltChart(const PivotResult& result, const PivotOptions& options) {
  Chart chart;
  chart.title = "How far the tool was tilted";
  chart.shows = fmt::format(
      "by how much the readings tilt three directions of the tool (degrees, RMS about the mean, "
      "least first), what their noise alone would, and {:g} times that, which it takes to "
      "determine the tip along a direction.",
      options.least_tilt_to_noise);
  chart.good =
      "three bars far above the marks, the least of 10 degrees or more. The tip's standard "
      "deviation along a direction falls as its bar grows: the least bar says along which it is "
      "known least.";
  chart.table = {{{"direction in T"},
                  {"tilt, degrees", true},
                  {"noise, degrees", true},
                  {"needed, degrees", true},
                  {"tip along it"}},
                 {}};
  Json names = Json::array(), tilts = Json::array(), needed = Json::array();
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d d = result.tilts.directions.col(k);
    // One over the other, for three stand side by side on a narrow screen; no -0.00.
    const Eigen::Vector3d rounded = (100.0 * d).array().round() / 100.0 + 0.0;
    const double least =
        std::max(options.least_tilt, options.least_tilt_to_noise * result.noise_tilts[k]);
    names.push_back(
        fmt::format("x {:.2f}<br>y {:.2f}<br>z {:.2f}", rounded.x(), rounded.y(), rounded.z()));
    tilts.push_back(kDegrees * result.tilts.rms[k]);
    needed.push_back(kDegrees * least);
    chart.table.rows.push_back(
        {fmt::format("{:.2f}, {:.2f}, {:.2f}", rounded.x(), rounded.y(), rounded.z()),
         fmt::format("{:.3g}", kDegrees * result.tilts.rms[k]),
         fmt::format("{:.2g}", kDegrees * result.noise_tilts[k]),
         fmt::format("{:.2g}", kDegrees * least),
         result.is_lost[k] ? "not determined" : "determined"});
  }
  chart.data = Json::array({{{"type", "bar"},
                             {"name", "tilt"},
                             {"x", names},
                             {"y", tilts},
                             {"marker", {{"color", "@after"}}}},
                            {{"type", "scatter"},
                             {"mode", "markers"},
                             {"name", "needed"},
                             {"x", names},
                             {"y", needed},
                             {"marker",
                              {{"color", "@before"},
                               {"symbol", "line-ew-open"},
                               {"size", 24},
                               {"line", {{"width", 3}}}}}}});
  Json x = OpenAxis("direction in T");
  x["type"] = "category", x["tickangle"] = 0;
  chart.layout = {{"height", 340}, {"xaxis", x}, {"yaxis", Axis("degrees, RMS", true)}};
  return chart;
}

}  // namespace hexcal
