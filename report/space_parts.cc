// SPDX-License-Identifier: BSD-3-Clause
#include "report/space_parts.h"

#include <algorithm>
#include <cmath>

namespace hexcal {

using Json = nlohmann::ordered_json;

Json SpaceTrace(const std::string& name,
                const char* mode,
                const std::vector<Eigen::Vector3d>& points,
                std::size_t run,
                const char* colour) {
  Json x = Json::array(), y = Json::array(), z = Json::array();
  for (std::size_t i = 0; i < points.size(); ++i) {
    x.push_back(1e3 * points[i].x());
    y.push_back(1e3 * points[i].y());
    z.push_back(1e3 * points[i].z());
    if (run > 0 && (i + 1) % run == 0)
      for (Json* list : {&x, &y, &z}) list->push_back(Json());
  }
  return {{"type", "scatter3d"},
          {"mode", mode},
          {"name", name},
          {"x", x},
          {"y", y},
          {"z", z},
          {"hoverinfo", "name"},
          {"line", {{"color", colour}, {"width", 4}}},
          {"marker", {{"color", colour}, {"size", 3}}}};
}

Json SpaceLayout() {
  const Json axis = {{"title", {{"text", ""}}},
                     {"gridcolor", "@grid"},
                     {"zerolinecolor", "@grid"},
                     {"color", "@muted"}};
  return {{"height", 560},
          {"margin", {{"l", 0}, {"r", 0}, {"t", 40}, {"b", 0}}},
          {"scene",
           {{"aspectmode", "data"},
            {"camera",
             {{"eye", {{"x", 1.4}, {"y", 1.4}, {"z", 0.9}}},
              {"center", {{"x", 0.0}, {"y", 0.0}, {"z", -0.12}}}}},
            {"xaxis", axis},
            {"yaxis", axis},
            {"zaxis", axis}}}};
}

double RoundFactor(double x) {
  constexpr double kMost = 1e6;  // beyond it only rounding would show
  if (!(x > 0.0) || !std::isfinite(x)) return 1.0;
  x = std::min(x, kMost);
  const double power = std::pow(10.0, std::floor(std::log10(x)));
  return power * (x >= 5.0 * power ? 5.0 : x >= 2.0 * power ? 2.0 : 1.0);
}

}  // namespace hexcal
