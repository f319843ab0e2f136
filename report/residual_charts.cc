// SPDX-License-Identifier: BSD-3-Clause
#include "report/residual_charts.h"

#include <fmt/format.h>

#include <algorithm>

#include "report/chart_parts.h"
#include "report/html/escape.h"
#include "report/quantity.h"

namespace hexcal {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kMilli = 1e3;
constexpr const char* kAxes[6] = {"x", "y", "z", "rx", "ry", "rz"};

// What residuals are shown against.
struct Abscissa {
  std::string words;           // "in order of visit"
  std::string title;           // of the axis
  const char* look;            // what a structure along it would mean
  std::vector<double> values;  // of every pose
};

Abscissa OrderAbscissa(std::size_t poses) {
  Abscissa order{"in order of visit", "order of visit", "trends and jumps", {}};
  for (std::size_t i = 0; i < poses; ++i) order.values.push_back(static_cast<double>(i + 1));
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

struct Quantity {
  int first;  // of the six numbers
  const char* title;
  const char* unit;
};

void AddPanels(const PoseResiduals& residuals,
               const Abscissa& against,
               const Quantity& quantity,
               const DrawnPoses& drawn,
               Chart* chart) {
  Json places = Json::array();
  for (const std::size_t i : drawn.indices) places.push_back(against.values[i]);
  for (int k = quantity.first; k < quantity.first + 3; ++k) {
    const int panel = k - quantity.first + 1;
    const auto add = [&](const char* name, const std::vector<Vector6d>& errors, bool is_before) {
      Json values = Json::array();
      for (const std::size_t i : drawn.indices) values.push_back(kMilli * errors[i][k]);
      Json trace = DotTrace(name, places, values, drawn.labels, is_before, panel);
      if (!residuals.before) trace["showlegend"] = false;
      MarkLeftOut(drawn.Of(residuals.used), &trace);
      chart->data.push_back(trace);
    };
    if (residuals.before) add("before", residuals.before->error, true);
    add("after", residuals.after.error, false);
    chart->layout[AxisKey("yaxis", panel)] =
        Axis(fmt::format("{}, {}", kAxes[k], quantity.unit), false);
    Json x = OpenAxis(panel == 3 ? against.title : "");
    if (panel < 3) x["matches"] = "x3", x["showticklabels"] = false;
    chart->layout[AxisKey("xaxis", panel)] = x;
  }
  chart->layout["grid"] = {{"rows", 3}, {"columns", 1}, {"pattern", "independent"}, {"ygap", 0.12}};
  chart->layout["height"] = 500;
}

HtmlTable TableOf(const PoseResiduals& residuals,
                  const Abscissa& against,
                  const Quantity& quantity,
                  const DrawnPoses& drawn) {
  HtmlTable table = {{{"pose"}, {against.title, true}}, {}};
  const auto add = [&](const char* when) {
    for (int k = quantity.first; k < quantity.first + 3; ++k)
      table.columns.push_back({fmt::format("{}{}, {}", when, kAxes[k], quantity.unit), true});
  };
  if (residuals.before) add("before, ");
  add(residuals.before ? "after, " : "");
  for (const std::size_t i : drawn.indices) {
    std::vector<std::string> row = {residuals.labels[i], fmt::format("{:.5g}", against.values[i])};
    const auto numbers = [&](const std::vector<Vector6d>& errors) {
      for (int k = quantity.first; k < quantity.first + 3; ++k)
        row.push_back(MilliText(errors[i][k]));
    };
    if (residuals.before) numbers(residuals.before->error);
    numbers(residuals.after.error);
    table.rows.push_back(row);
  }
  return table;
}

Chart AxesChart(const PoseResiduals& residuals, const Abscissa& against, const Quantity& quantity) {
  const DrawnPoses drawn(residuals.labels);
  Chart chart;
  chart.title = fmt::format("{} residuals {}", quantity.title, against.words);
  chart.shows = fmt::format(
      "measured minus predicted {} each axis of the tool ({}), pose by pose, {}{} (hover for the "
      "pose's name).{}",
      quantity.first == 0 ? "along" : "about",
      quantity.unit,
      against.words,
      residuals.before ? ", before and after what was found" : "",
      drawn.note + LeftOutNote(drawn.Of(residuals.used)));
  chart.good = fmt::format(
      "a structureless band about zero{}; waves, {}, or single far points mean that {}.",
      residuals.before ? " after" : "",
      against.look,
      residuals.before ? "something is still missing"
                       : "the model misses something (hexcal discover looks for it)");
  AddPanels(residuals, against, quantity, drawn, &chart);
  chart.table = TableOf(residuals, against, quantity, drawn);
  return chart;
}

}  // namespace

DrawnPoses::DrawnPoses(const std::vector<std::string>& all) {
  const std::size_t stride = StrideOf(all.size());
  for (std::size_t i = 0; i < all.size(); i += stride) {
    indices.push_back(i);
    order.push_back(i + 1);
    labels.push_back(EscapeLabel(all[i]));
  }
  if (stride > 1) note = fmt::format(" One pose in {} is drawn.", stride);
}

std::vector<bool> DrawnPoses::Of(const std::vector<bool>& all) const {
  std::vector<bool> drawn;
  for (const std::size_t i : indices) drawn.push_back(all[i]);
  return drawn;
}

std::vector<Chart> ResidualCharts(const PoseResiduals& residuals) {
  if (residuals.labels.empty()) return {};
  std::vector<Abscissa> abscissas = {OrderAbscissa(residuals.labels.size())};
  if (!residuals.times.empty()) abscissas.push_back(TimeAbscissa(residuals.times));
  std::vector<Chart> charts;
  for (const Abscissa& against : abscissas) {
    charts.push_back(AxesChart(residuals, against, {0, "Position", "mm"}));
    charts.push_back(AxesChart(residuals, against, {3, "Orientation", "mrad"}));
  }
  return charts;
}

}  // namespace hexcal
