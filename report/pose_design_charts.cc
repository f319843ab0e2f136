// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>

#include <array>

#include "config/units.h"
#include "report/chart_parts.h"
#include "report/html/escape.h"
#include "report/pose_design.h"

namespace hexcal {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kMilli = 1e3;
constexpr double kDegree = kPi / 180.0;
constexpr const char* kCoordinates[6] = {"x", "y", "z", "rx", "ry", "rz"};

// A strip of the first picture: the values of all poses, and the range that they are held against.
struct Strip {
  std::string name, unit;
  const std::vector<Vector6d>* values;
  int index;
  std::array<double, 2> span, range;

  double Percent(double value) const {
    return range[1] > range[0] ? 100.0 * (value - range[0]) / (range[1] - range[0]) : 50.0;
  }
};

std::vector<Strip> StripsOf(const PoseDesign& design, const Workspace& workspace) {
  std::vector<Strip> strips;
  for (int i = 0; i < 6; ++i)
    strips.push_back({kCoordinates[i],
                      i < 3 ? "mm" : "mrad",
                      &design.poses,
                      i,
                      design.span[i],
                      workspace.box[i]});
  if (design.leg_limits)
    for (int i = 0; i < 6; ++i)
      strips.push_back({fmt::format("leg {}", i + 1),
                        "mm",
                        &design.legs,
                        i,
                        design.leg_span[i],
                        *design.leg_limits});
  return strips;
}

Json Edge(double x) {
  return {{"type", "line"},
          {"x0", x},
          {"x1", x},
          {"yref", "paper"},
          {"y0", 0},
          {"y1", 1},
          {"line", {{"color", "@before"}, {"dash", "dash"}, {"width", 1}}}};
}

Chart RangeChart(const PoseDesign& design, const Workspace& workspace) {
  Chart chart;
  chart.title = "Where the measured poses lie";
  chart.shows = fmt::format(
      "every measured pose along each of the six numbers of T_A^B, as a part of {}{} (hover for "
      "the "
      "pose).",
      workspace.is_stated ? "the workspace that the requirement file states"
                          : "what the poses span, as no workspace was stated",
      design.leg_limits ? ", and along each leg, as a part of what its limits allow" : "");
  chart.good =
      "points all over every strip of the first six, to both dashed ends: beyond the poses only "
      "the model speaks. Legs should stay within their limits.";
  chart.table = {{{""},
                  {"from", true},
                  {"to", true},
                  {"range from", true},
                  {"range to", true},
                  {"covered", true}},
                 {}};
  const std::size_t stride = StrideOf(design.poses.size());
  for (const Strip& strip : StripsOf(design, workspace)) {
    Json x = Json::array(), y = Json::array(), texts = Json::array();
    for (std::size_t i = 0; i < strip.values->size(); i += stride) {
      const double value = (*strip.values)[i][strip.index];
      x.push_back(strip.Percent(value));
      y.push_back(strip.name);
      texts.push_back(EscapeLabel(design.labels[i]) +
                      fmt::format(": {:.3f} {}", kMilli * value, strip.unit));
    }
    chart.data.push_back({{"type", "scatter"},
                          {"mode", "markers"},
                          {"x", x},
                          {"y", y},
                          {"text", texts},
                          {"showlegend", false},
                          {"hovertemplate", "%{text}<extra>%{y}</extra>"},
                          {"marker", {{"color", "@after"}, {"size", 6}, {"opacity", 0.55}}}});
    // Of the range, not of the poses: what lies beyond it covers nothing.
    const double covered = std::clamp(strip.Percent(strip.span[1]), 0.0, 100.0) -
                           std::clamp(strip.Percent(strip.span[0]), 0.0, 100.0);
    chart.table.rows.push_back({fmt::format("{}, {}", strip.name, strip.unit),
                                fmt::format("{:.3f}", kMilli * strip.span[0]),
                                fmt::format("{:.3f}", kMilli * strip.span[1]),
                                fmt::format("{:.3f}", kMilli * strip.range[0]),
                                fmt::format("{:.3f}", kMilli * strip.range[1]),
                                fmt::format("{:.0f} %", covered)});
  }
  Json y = OpenAxis("");
  y["autorange"] = "reversed";
  y["type"] = "category";
  chart.layout = {{"height", design.leg_limits ? 470 : 320},
                  {"xaxis", OpenAxis("% of the range")},
                  {"yaxis", y},
                  {"shapes", Json::array({Edge(0.0), Edge(100.0)})}};
  return chart;
}

Chart RotationChart(const PoseDesign& design) {
  Chart chart;
  chart.title = "How the poses are turned";
  chart.shows =
      "the rotation from the mean orientation to that of every pose, as a vector along its axis "
      "and "
      "as long as its angle, in the mean frame A (degrees; from the side and from the front).";
  chart.good =
      "a cloud that is wide in at least two directions. Rotations about one axis alone leave "
      "some of the 12 parameters undetermined, and small ones tell little: uncertainty falls with "
      "the angle "
      "and with the angle between the axes (Tsai and Lenz 1989).";
  const std::size_t stride = StrideOf(design.rotations.size());
  for (int panel = 1; panel <= 2; ++panel) {
    Json x = Json::array(), y = Json::array(), labels = Json::array();
    for (std::size_t i = 0; i < design.rotations.size(); i += stride) {
      x.push_back(design.rotations[i][0] / kDegree);
      y.push_back(design.rotations[i][panel] / kDegree);
      labels.push_back(EscapeLabel(design.labels[i]));
    }
    Json trace = DotTrace("poses", x, y, labels, false, panel);
    trace["showlegend"] = false;
    chart.data.push_back(trace);
    Json across = OpenAxis("about x, °"), up = OpenAxis(panel == 1 ? "about y, °" : "about z, °");
    up["scaleanchor"] = AxisKey("x", panel);
    chart.layout[AxisKey("xaxis", panel)] = across;
    chart.layout[AxisKey("yaxis", panel)] = up;
  }
  chart.layout["grid"] = {{"rows", 2}, {"columns", 1}, {"pattern", "independent"}, {"ygap", 0.25}};
  chart.layout["height"] = 520;
  chart.table = {{{"main axis, frame A"}, {"RMS of the rotations about it, °", true}}, {}};
  for (int k = 0; k < 3; ++k)
    chart.table.rows.push_back({fmt::format("({:.2f}, {:.2f}, {:.2f})",
                                            design.main_axes(0, k),
                                            design.main_axes(1, k),
                                            design.main_axes(2, k)),
                                fmt::format("{:.3f}", design.rotation_rms[k] / kDegree)});
  chart.table.rows.push_back({"largest angle between two axes",
                              fmt::format("{:.1f}", design.angle_between_axes / kDegree)});
  return chart;
}

}  // namespace

std::vector<Chart> PoseDesignCharts(const PoseDesign& design, const Workspace& workspace) {
  return {RangeChart(design, workspace), RotationChart(design)};
}

}  // namespace hexcal
