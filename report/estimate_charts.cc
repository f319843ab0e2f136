// SPDX-License-Identifier: BSD-3-Clause
#include "report/estimate_charts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "estimator/quantiles.h"
#include "report/chart_parts.h"
#include "report/quantity.h"
#include "report/residual_charts.h"

namespace hexcal {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kMilli = 1e3;

std::vector<std::string> LabelsOf(const std::vector<PoseCheck>& poses) {
  std::vector<std::string> labels;
  for (const PoseCheck& pose : poses) labels.push_back(pose.label);
  return labels;
}

// Whether there was hardly anything to fall: a closed form is a good start.
bool StartsAtItsEnd(const std::vector<IterationRecord>& iterations) {
  constexpr double kNear = 0.05;
  if (iterations.empty()) return false;
  const IterationRecord &first = iterations.front(), &last = iterations.back();
  return std::abs(first.rmspe - last.rmspe) <= kNear * last.rmspe &&
         std::abs(first.rmsoe - last.rmsoe) <= kNear * last.rmsoe;
}

}  // namespace

Chart ConvergenceChart(const std::vector<IterationRecord>& iterations, const std::string& solver) {
  Chart chart;
  chart.title = fmt::format("How the {} arrived", solver);
  chart.shows =
      "RMS position (mm) and orientation error (mrad) at the start and after each iteration.";
  chart.good =
      StartsAtItsEnd(iterations)
          ? "a level line, as here: the start was within 5 % of the solution, and the iterations "
            "only polished it."
          : "a steep fall to a level within a few iterations, and nothing after that.";
  chart.table = {{{"iteration", true}, {"position, mm", true}, {"orientation, mrad", true}}, {}};
  Json steps = Json::array(), position = Json::array(), orientation = Json::array();
  for (std::size_t i = 0; i < iterations.size(); ++i) {
    steps.push_back(i);
    position.push_back(kMilli * iterations[i].rmspe);
    orientation.push_back(kMilli * iterations[i].rmsoe);
    chart.table.rows.push_back({fmt::format("{}", i),
                                fmt::format("{:.5g}", kMilli * iterations[i].rmspe),
                                fmt::format("{:.5g}", kMilli * iterations[i].rmsoe)});
  }
  const auto line = [&](const char* name, const Json& values, const char* colour) {
    return Json{{"type", "scatter"},
                {"mode", "lines+markers"},
                {"name", name},
                {"x", steps},
                {"y", values},
                {"line", {{"color", colour}}}};
  };
  chart.data = Json::array({line("position, mm", position, "@after"),
                            line("orientation, mrad", orientation, "@before")});
  std::vector<double> all;
  for (const IterationRecord& i : iterations)
    all.push_back(kMilli * i.rmspe), all.push_back(kMilli * i.rmsoe);
  Json x = OpenAxis("iteration");
  x["rangemode"] = "nonnegative";
  x["dtick"] = std::max<std::size_t>(1, (iterations.size() + 8) / 10);
  chart.layout = {{"height", 340}, {"xaxis", x}, {"yaxis", LogAxis("RMS", all)}};
  return chart;
}

Chart HeldOutChart(const std::vector<PoseCheck>& poses, const std::vector<bool>& used) {
  Chart chart;
  chart.title = "Each pose as the others predict it";
  chart.shows =
      "how far each pose is off what base and tool from all others predict, in squared standard "
      "deviations of noise and prediction (6 expected), and the limit for 95 % of the poses.";
  chart.good = "one dot in twenty above the line, none far above it.";
  const double limit = ChiSquareQuantile(0.95, 6.0);
  Json values = Json::array();
  chart.table = {
      {{"pose"}, {"squared sigmas", true}, {"position, mm", true}, {"orientation, mrad", true}},
      {}};
  const DrawnPoses drawn(LabelsOf(poses));
  chart.shows += drawn.note + LeftOutNote(drawn.Of(used));
  for (const std::size_t i : drawn.indices) {
    const PoseCheck& pose = poses[i];
    values.push_back(pose.squared);
    chart.table.rows.push_back({pose.label,
                                fmt::format("{:.2f}", pose.squared),
                                MilliText(pose.held_out.head<3>().norm()),
                                MilliText(pose.held_out.tail<3>().norm())});
  }
  Json trace = DotTrace("poses", drawn.order, values, drawn.labels, false, 1);
  MarkLeftOut(drawn.Of(used), &trace);
  chart.data = Json::array({trace});
  chart.layout = {{"height", 340},
                  {"shapes", Json::array({Level("95 %", limit, "@floor")})},
                  {"xaxis", OpenAxis("order of visit")},
                  {"yaxis", Axis("squared sigmas", true)}};
  return chart;
}

Chart SmallestChart(const std::vector<PoseCheck>& poses, const std::vector<bool>& used) {
  Chart chart;
  chart.title = "The smallest error of a pose that would be found";
  chart.shows =
      "for each pose how large an error of its measurement, along the worst direction, would have "
      "to be for the search for outliers to find it with 80 % (one clean dataset in a hundred "
      "lists "
      "a pose).";
  chart.good =
      "an even row. Poses that stand out are hardly checked by the others: an error there goes "
      "unseen and moves base and tool.";
  Json position = Json::array(), orientation = Json::array();
  chart.table = {
      {{"pose"}, {"position, mm", true}, {"orientation, mrad", true}, {"redundancy", true}}, {}};
  const DrawnPoses drawn(LabelsOf(poses));
  chart.shows += drawn.note + LeftOutNote(drawn.Of(used));
  for (const std::size_t i : drawn.indices) {
    const PoseCheck& pose = poses[i];
    position.push_back(kMilli * pose.smallest_position);
    orientation.push_back(kMilli * pose.smallest_orientation);
    chart.table.rows.push_back({pose.label,
                                fmt::format("{:.3f}", kMilli * pose.smallest_position),
                                fmt::format("{:.3f}", kMilli * pose.smallest_orientation),
                                fmt::format("{:.2f}", pose.redundancy)});
  }
  chart.data =
      Json::array({DotTrace("position, mm", drawn.order, position, drawn.labels, false, 1),
                   DotTrace("orientation, mrad", drawn.order, orientation, drawn.labels, true, 1)});
  for (Json& trace : chart.data) MarkLeftOut(drawn.Of(used), &trace);
  chart.layout = {
      {"height", 340}, {"xaxis", OpenAxis("order of visit")}, {"yaxis", Axis("mm and mrad", true)}};
  return chart;
}

}  // namespace hexcal
