// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace hexcal {

// Pieces of plotly.js charts in space. Points in m are drawn in mm.

// Points, or lines with a gap after every `run` points.
nlohmann::ordered_json SpaceTrace(const std::string& name,
                                  const char* mode,
                                  const std::vector<Eigen::Vector3d>& points,
                                  std::size_t run,
                                  const char* colour);

// All axes at one scale, about all points of these traces: a box whose diagonal is 2, so that the
// page knows from how far it is seen whole (assets/page.js).
nlohmann::ordered_json SpaceLayout(const nlohmann::ordered_json& data);

// By how much what is too small to be seen is enlarged: 1, 2 or 5 times a power of ten, not above
// x.
double RoundFactor(double x);

}  // namespace hexcal
