// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "report/html/page.h"

namespace hexcal {

// Pieces of plotly.js charts.

// An axis with a title; from_zero: zero is in its range.
nlohmann::ordered_json Axis(const std::string& title, bool from_zero);

// One without a line at zero, for lengths and counts.
nlohmann::ordered_json OpenAxis(const std::string& title);

// A logarithmic one for these values, with marks that do not crowd each other.
nlohmann::ordered_json LogAxis(const std::string& title, const std::vector<double>& values);

// "xaxis" of the first panel, "xaxis2" of the second...
std::string AxisKey(const std::string& axis, int panel);

// Dots in a panel: hollow and pale before, full after. The legend shows those of the first panel.
nlohmann::ordered_json DotTrace(const char* name,
                                const nlohmann::ordered_json& x,
                                const nlohmann::ordered_json& y,
                                const nlohmann::ordered_json& labels,
                                bool is_before,
                                int panel);

// Sets dots off that stand for poses that were left out of a fit: used, of each dot. And what says
// so in words: empty where all were used.
void MarkLeftOut(const std::vector<bool>& used,
                 nlohmann::ordered_json* trace,
                 const char* symbol = "x-thin-open");
std::string LeftOutNote(const std::vector<bool>& used);

// Horizontal bars, the first on top, with their names (not escaped) above them, where these have
// room on narrow screens too. hover: of a bar, after its name. Sets the layout's height, y axis and
// annotations, and that the chart has rows.
nlohmann::ordered_json NamedBars(const std::vector<std::string>& names,
                                 const nlohmann::ordered_json& lengths,
                                 const std::string& hover,
                                 Chart* chart);

// A dashed level across the picture, for "shapes" of a layout.
nlohmann::ordered_json Level(const char* name, double y, const char* colour);

// A colour axis from -largest to largest, pale at zero.
nlohmann::ordered_json DivergingColours(double largest, const char* unit);

// Every such pose of so many is drawn, so that a page of a million poses still opens.
std::size_t StrideOf(std::size_t count);

}  // namespace hexcal
