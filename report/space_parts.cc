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

Json SpaceLayout(const Json& data) {
  constexpr const char* kAxes[3] = {"x", "y", "z"};
  constexpr double kRoom = 1.0 / 32.0;  // at both ends, of the widest
  Eigen::Array3d low = Eigen::Array3d::Constant(HUGE_VAL), high = -low;
  for (const Json& trace : data)
    for (int k = 0; k < 3; ++k)
      for (const Json& value : trace[kAxes[k]])
        if (value.is_number()) {
          low[k] = std::min(low[k], value.get<double>());
          high[k] = std::max(high[k], value.get<double>());
        }
  const Eigen::Array3d middle = 0.5 * (low + high);
  const double widest = std::max((high - low).maxCoeff(), 1e-9);
  const Eigen::Array3d half = 0.5 * (high - low).max(0.1 * widest) + kRoom * widest;
  Json scene = {{"aspectmode", "manual"}};
  for (int k = 0; k < 3; ++k) {
    scene["aspectratio"][kAxes[k]] = 2.0 * half[k] / half.matrix().norm();
    scene[std::string(kAxes[k]) + "axis"] = {{"title", {{"text", ""}}},
                                             {"range", {middle[k] - half[k], middle[k] + half[k]}},
                                             {"gridcolor", "@grid"},
                                             {"zerolinecolor", "@grid"},
                                             {"color", "@muted"}};
  }
  return {{"height", 560},
          {"margin", {{"l", 0}, {"r", 0}, {"t", 40}, {"b", 0}}},
          {"legend", {{"itemsizing", "constant"}}},
          {"scene", scene}};
}

double RoundFactor(double x) {
  constexpr double kMost = 1e6;  // beyond it only rounding would show
  if (!(x > 0.0) || !std::isfinite(x)) return 1.0;
  x = std::min(x, kMost);
  const double power = std::pow(10.0, std::floor(std::log10(x)));
  return power * (x >= 5.0 * power ? 5.0 : x >= 2.0 * power ? 2.0 : 1.0);
}

}  // namespace hexcal
