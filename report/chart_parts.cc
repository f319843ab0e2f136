// SPDX-License-Identifier: BSD-3-Clause
#include "report/chart_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/html/escape.h"

namespace hexcal {

using Json = nlohmann::ordered_json;

Json Axis(const std::string& title, bool from_zero) {
  Json axis = {{"title", {{"text", title}, {"standoff", 6}}}};
  if (from_zero) axis["rangemode"] = "tozero";
  return axis;
}

Json OpenAxis(const std::string& title) {
  Json axis = Axis(title, false);
  axis["zeroline"] = false;
  return axis;
}

Json LogAxis(const std::string& title, const std::vector<double>& values) {
  constexpr double kManyDecades = 1.5;
  double low = 0.0, high = 0.0;  // of those above zero
  for (const double value : values) {
    if (!(value > 0.0)) continue;
    low = low > 0.0 ? std::min(low, value) : value;
    high = std::max(high, value);
  }
  Json axis = OpenAxis(title);
  axis["type"] = "log";
  if (!(low > 0.0) || std::log10(high / low) > kManyDecades) {
    axis["dtick"] = 1;  // powers of ten
    return axis;
  }
  // 1, 2 and 5 times these, with every digit: plotly alone would write 2 for 0.2.
  Json values_of_ticks = Json::array(), texts = Json::array();
  for (int power = static_cast<int>(std::floor(std::log10(low))) - 1;
       std::pow(10.0, power) <= 10.0 * high;
       ++power)
    for (const int digit : {1, 2, 5}) {
      const std::string text = fmt::format("{:g}", digit * std::pow(10.0, power));
      values_of_ticks.push_back(digit * std::pow(10.0, power));
      texts.push_back(text);
    }
  axis["tickmode"] = "array";
  axis["tickvals"] = values_of_ticks;
  axis["ticktext"] = texts;
  return axis;
}

std::string AxisKey(const std::string& axis, int panel) {
  return panel == 1 ? axis : fmt::format("{}{}", axis, panel);
}

Json DotTrace(
    const char* name, const Json& x, const Json& y, const Json& labels, bool is_before, int panel) {
  return {{"type", "scatter"},
          {"mode", "markers"},
          {"name", name},
          {"x", x},
          {"y", y},
          {"text", labels},
          {"legendgroup", name},
          {"showlegend", panel == 1},
          {"xaxis", AxisKey("x", panel)},
          {"yaxis", AxisKey("y", panel)},
          {"marker",
           {{"color", is_before ? "@before" : "@after"},
            {"symbol", is_before ? "circle-open" : "circle"},
            {"size", is_before ? 7 : 6}}}};
}

void MarkLeftOut(const std::vector<bool>& used, Json* trace, const char* symbol_of_left_out) {
  constexpr int kLarger = 4;
  if (LeftOutNote(used).empty()) return;
  Json& marker = (*trace)["marker"];
  const Json symbol = marker.value("symbol", "circle"), size = marker["size"];
  Json symbols = Json::array(), sizes = Json::array();
  for (const bool is_used : used) {
    symbols.push_back(is_used ? symbol : Json(symbol_of_left_out));
    sizes.push_back(is_used ? size : Json(size.get<int>() + kLarger));
  }
  marker["symbol"] = symbols, marker["size"] = sizes;
}

std::string LeftOutNote(const std::vector<bool>& used) {
  return std::count(used.begin(), used.end(), false) == 0
             ? ""
             : " A cross is of a pose that was left out of the fit.";
}

Json NamedBars(const std::vector<std::string>& names,
               const Json& lengths,
               const std::string& hover,
               Chart* chart) {
  constexpr int kRowHeight = 40, kNameAbove = 16, kRest = 76;  // px
  Json rows = Json::array(), labels = Json::array(), annotations = Json::array();
  for (std::size_t k = 0; k < names.size(); ++k) {
    rows.push_back(k);
    labels.push_back(EscapeLabel(names[k]));
    annotations.push_back({{"xref", "paper"},
                           {"x", 0},
                           {"xanchor", "left"},
                           {"y", k},
                           {"yshift", kNameAbove},
                           {"text", labels.back()},
                           {"font", {{"size", 12}}},
                           {"showarrow", false}});
  }
  chart->has_rows = true;
  const double last = static_cast<double>(names.size());
  chart->layout["height"] = kRest + kRowHeight * static_cast<int>(names.size());
  chart->layout["yaxis"] = {{"range", {last - 0.5, -0.8}},
                            {"showticklabels", false},
                            {"showgrid", false},
                            {"zeroline", false}};
  chart->layout["margin"] = {{"l", 16}, {"r", 16}, {"t", 12}, {"b", 46}};
  chart->layout["annotations"] = annotations;
  return {{"type", "bar"},
          {"orientation", "h"},
          {"y", rows},
          {"x", lengths},
          {"width", 0.36},
          {"text", labels},
          {"textposition", "none"},
          {"marker", {{"color", "@after"}}},
          {"hovertemplate", "%{text}: " + hover + "<extra></extra>"}};
}

Json Level(const char* name, double y, const char* colour) {
  return {{"type", "line"},
          {"xref", "paper"},
          {"x0", 0},
          {"x1", 1},
          {"y0", y},
          {"y1", y},
          {"name", name},
          {"showlegend", true},
          {"line", {{"color", colour}, {"dash", "dash"}, {"width", 2}}}};
}

Json DivergingColours(double largest, const char* unit) {
  const double end = largest > 0.0 ? largest : 1.0;
  Json scale = Json::array();
  scale.push_back(Json::array({0.0, "@low"}));
  scale.push_back(Json::array({0.5, "@middle"}));
  scale.push_back(Json::array({1.0, "@high"}));
  return {
      {"cmin", -end},
      {"cmax", end},
      {"colorscale", scale},
      {"colorbar", {{"title", {{"text", unit}}}, {"thickness", 12}, {"exponentformat", "power"}}}};
}

std::size_t StrideOf(std::size_t count) {
  constexpr std::size_t kMostDrawn = 2000;
  return (count + kMostDrawn - 1) / kMostDrawn + (count == 0);
}

}  // namespace hexcal
