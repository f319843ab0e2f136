// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <random>
#include <vector>

#include "estimator/estimate.h"
#include "estimator/marker_observations.h"
#include "estimator/streamed_solver.h"

namespace hexcal::testing {

// A calibration by markers with a known truth. Rigid bodies have four markers and one marker or
// another is hidden in some poses and frames; centroid bodies have three, all seen.
struct MarkerScene {
  bool tracker_is_static = false;                 // and the base hidden in most poses
  std::array<bool, 2> centroid = {false, false};  // base, tool
  double robot_noise = 0.0;                       // m; ten times that in rad, and unequal axes
  Eigen::Vector3d sigma = Eigen::Vector3d(1e-4, 0.7e-4, 3e-4);
  int poses = 9;
  int frames = 3;
};

struct MarkerTruth {
  MarkerScene scene;
  BaseAndTool mounts;
  Dataset dataset;  // without readings
};
MarkerTruth MakeMarkerTruth(std::mt19937_64& rng, const MarkerScene& scene);

// A draw of the readings; noise: a factor on every sigma, 0 for none. The drawn dataset states its
// sigma.
Dataset DrawMarkers(const MarkerTruth& truth, std::uint64_t seed, double noise = 1.0);

// The small motion that takes b to a, as in Moved().
Eigen::VectorXd BlockDifference(const ParameterBlocks& a, const ParameterBlocks& b);

}  // namespace hexcal::testing
