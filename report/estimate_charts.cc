// SPDX-License-Identifier: BSD-3-Clause
#include "report/estimate_charts.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "config/units.h"
#include "estimator/quantiles.h"
#include "report/chart_parts.h"
#include "report/html/escape.h"

namespace hexcal {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kMilli = 1e3;

// Those that are drawn, in order of visit.
struct Drawn {
  Json order = Json::array(), labels = Json::array();
  std::string note;  // of those that are not
};

template <typename Pose>
Drawn DrawnOf(const std::vector<Pose>& poses) {
  Drawn drawn;
  const std::size_t stride = StrideOf(poses.size());
  for (std::size_t i = 0; i < poses.size(); i += stride) {
    drawn.order.push_back(i + 1);
    drawn.labels.push_back(EscapeLabel(poses[i].label));
  }
  if (stride > 1) drawn.note = fmt::format(" One pose in {} is drawn.", stride);
  return drawn;
}

// What residuals are shown against.
struct Abscissa {
  std::string words;           // "in order of visit"
  std::string title;           // of the axis
  const char* look;            // what a structure along it would mean
  std::vector<double> values;  // of every pose
};

Abscissa OrderAbscissa(const Estimate& estimate) {
  Abscissa order{"in order of visit", "order of visit", "trends and jumps", {}};
  for (std::size_t i = 0; i < estimate.poses.size(); ++i)
    order.values.push_back(static_cast<double>(i + 1));
  return order;
}

// From the first pose on, in a unit that makes short numbers.
Abscissa TimeAbscissa(const std::vector<double>& times) {
  const auto [first, last] = std::minmax_element(times.begin(), times.end());
  const double span = *last - *first;
  const double unit = span > 10800.0 ? 3600.0 : span > 300.0 ? 60.0 : 1.0;
  Abscissa time{"over time",
                fmt::format("time, {}",
                            unit == 1.0    ? "s"
                            : unit == 60.0 ? "min"
                                           : "h"),
                "drifts (heat, a tracker or base that settles)",
                {}};
  for (const double t : times) time.values.push_back((t - *first) / unit);
  return time;
}

Chart AxesChart(const Estimate& estimate,
                const Abscissa& against,
                int first,
                const char* title,
                const char* unit) {
  constexpr const char* kAxes[6] = {"x", "y", "z", "about x", "about y", "about z"};
  Chart chart;
  chart.title = fmt::format("{} residuals {}", title, against.words);
  chart.shows = fmt::format(
      "measured minus predicted along each axis of the tool ({}), pose by pose, {} (hover for the "
      "pose's name).",
      unit,
      against.words);
  chart.good = fmt::format(
      "a structureless band about zero; waves, {}, or single far points mean that the model misses "
      "something (hexcal discover looks for it).",
      against.look);
  const Drawn drawn = DrawnOf(estimate.poses);
  const std::size_t stride = StrideOf(estimate.poses.size());
  chart.shows += drawn.note;
  chart.table = {{{"pose"}, {against.title, true}}, {}};
  Json places = Json::array();
  for (std::size_t i = 0; i < estimate.poses.size(); i += stride)
    places.push_back(against.values[i]);
  for (int k = first; k < first + 3; ++k) {
    Json values = Json::array();
    for (std::size_t i = 0; i < estimate.poses.size(); i += stride)
      values.push_back(kMilli * estimate.poses[i].residual[k]);
    const int panel = k - first + 1;
    Json trace = DotTrace(title, places, values, drawn.labels, false, panel);
    trace["showlegend"] = false;
    chart.data.push_back(trace);
    chart.layout[AxisKey("yaxis", panel)] = Axis(fmt::format("{}, {}", kAxes[k], unit), false);
    Json x = OpenAxis(panel == 3 ? against.title : "");
    if (panel < 3) x["matches"] = "x3", x["showticklabels"] = false;
    chart.layout[AxisKey("xaxis", panel)] = x;
    chart.table.columns.push_back({fmt::format("{}, {}", kAxes[k], unit), true});
  }
  chart.layout["grid"] = {{"rows", 3}, {"columns", 1}, {"pattern", "independent"}, {"ygap", 0.12}};
  chart.layout["height"] = 500;
  for (std::size_t i = 0; i < estimate.poses.size(); i += stride) {
    const PoseResult& pose = estimate.poses[i];
    std::vector<std::string> row = {pose.label, fmt::format("{:.5g}", against.values[i])};
    for (int k = first; k < first + 3; ++k)
      row.push_back(fmt::format("{:.4f}", kMilli * pose.residual[k]));
    chart.table.rows.push_back(row);
  }
  return chart;
}

}  // namespace

std::vector<Chart> LeftOverCharts(const Estimate& estimate, const LeftOver& left) {
  std::vector<Abscissa> abscissas = {OrderAbscissa(estimate)};
  if (!left.times.empty()) abscissas.push_back(TimeAbscissa(left.times));
  std::vector<Chart> charts;
  for (const Abscissa& against : abscissas) {
    charts.push_back(AxesChart(estimate, against, 0, "Position", "mm"));
    charts.push_back(AxesChart(estimate, against, 3, "Orientation", "mrad"));
  }
  return charts;
}

Chart HistogramChart(const Estimate& estimate) {
  constexpr double kWidth = 0.5, kEnd = 4.0;
  constexpr int kSteps = 80;  // of the line
  constexpr int kBins = static_cast<int>(2.0 * kEnd / kWidth);
  Chart chart;
  chart.title = "Residuals in standard deviations of the noise";
  chart.shows =
      "how often residuals of each size occur, positions and orientations apart, in standard "
      "deviations (the mean over poses and axes); the line is the normal distribution.";
  chart.good =
      "bars along the line. Narrower: the stated noise is too large; wider: too small, or the "
      "model misses something; single bars at the ends: outliers.";
  chart.table = {
      {{"from, sigmas", true}, {"positions", true}, {"orientations", true}, {"ideal", true}}, {}};
  std::array<std::array<int, kBins>, 2> counts{};
  for (const PoseResult& pose : estimate.poses)
    for (int k = 0; k < 6; ++k) {
      const double sigma = k < 3 ? estimate.noise.position : estimate.noise.orientation;
      if (!(sigma > 0.0)) continue;
      const double bin = std::floor((pose.residual[k] / sigma + kEnd) / kWidth);
      ++counts[k / 3][static_cast<std::size_t>(std::clamp(bin, 0.0, kBins - 1.0))];
    }
  Json middles = Json::array();
  std::array<Json, 2> bars = {Json::array(), Json::array()};
  const double all = 3.0 * static_cast<double>(estimate.poses.size());
  for (int bin = 0; bin < kBins; ++bin) {
    const double low = -kEnd + kWidth * bin;
    const double expected =
        all * 0.5 * (std::erf((low + kWidth) / std::sqrt(2.0)) - std::erf(low / std::sqrt(2.0)));
    middles.push_back(low + 0.5 * kWidth);
    for (int part = 0; part < 2; ++part) bars[part].push_back(counts[part][bin]);
    chart.table.rows.push_back({fmt::format("{:.1f}", low),
                                fmt::format("{}", counts[0][bin]),
                                fmt::format("{}", counts[1][bin]),
                                fmt::format("{:.1f}", expected)});
  }
  Json sizes = Json::array(), ideal = Json::array();
  for (int i = 0; i <= kSteps; ++i) {
    const double x = kEnd * (2.0 * i / kSteps - 1.0);
    sizes.push_back(x);
    ideal.push_back(all * kWidth * std::exp(-0.5 * x * x) / std::sqrt(2.0 * kPi));
  }
  const auto bar = [&](const char* name, const Json& heights, const char* colour) {
    return Json{{"type", "bar"},
                {"name", name},
                {"x", middles},
                {"y", heights},
                {"marker", {{"color", colour}}}};
  };
  chart.data = Json::array({bar("positions", bars[0], "@after"),
                            bar("orientations", bars[1], "@before"),
                            {{"type", "scatter"},
                             {"mode", "lines"},
                             {"name", "normal distribution"},
                             {"x", sizes},
                             {"y", ideal},
                             {"line", {{"color", "@floor"}, {"width", 2}}}}});
  chart.layout = {{"height", 360},
                  {"barmode", "group"},
                  {"xaxis", OpenAxis("standard deviations")},
                  {"yaxis", Axis("residuals", true)}};
  return chart;
}

Chart ConvergenceChart(const std::vector<IterationRecord>& iterations, const std::string& solver) {
  Chart chart;
  chart.title = fmt::format("How the {} arrived", solver);
  chart.shows =
      "RMS position (mm) and orientation error (mrad) at the start and after each iteration.";
  chart.good = "a steep fall to a level within a few iterations, and nothing after that.";
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
  Json y = OpenAxis("RMS");
  y["type"] = "log";
  Json x = OpenAxis("iteration");
  x["rangemode"] = "nonnegative";
  x["dtick"] = std::max<std::size_t>(1, iterations.size() / 10);
  chart.layout = {{"height", 340}, {"xaxis", x}, {"yaxis", y}};
  return chart;
}

Chart HeldOutChart(const std::vector<PoseCheck>& poses) {
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
  const Drawn drawn = DrawnOf(poses);
  chart.shows += drawn.note;
  for (std::size_t i = 0; i < poses.size(); i += StrideOf(poses.size())) {
    const PoseCheck& pose = poses[i];
    values.push_back(pose.squared);
    chart.table.rows.push_back({pose.label,
                                fmt::format("{:.2f}", pose.squared),
                                fmt::format("{:.4f}", kMilli * pose.held_out.head<3>().norm()),
                                fmt::format("{:.4f}", kMilli * pose.held_out.tail<3>().norm())});
  }
  Json trace = DotTrace("poses", drawn.order, values, drawn.labels, false, 1);
  chart.data = Json::array({trace});
  chart.layout = {{"height", 340},
                  {"shapes", Json::array({Level("95 %", limit, "@floor")})},
                  {"xaxis", OpenAxis("order of visit")},
                  {"yaxis", Axis("squared sigmas", true)}};
  return chart;
}

Chart SmallestChart(const std::vector<PoseCheck>& poses) {
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
  const Drawn drawn = DrawnOf(poses);
  chart.shows += drawn.note;
  for (std::size_t i = 0; i < poses.size(); i += StrideOf(poses.size())) {
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
  chart.layout = {
      {"height", 340}, {"xaxis", OpenAxis("order of visit")}, {"yaxis", Axis("mm and mrad", true)}};
  return chart;
}

}  // namespace hexcal
