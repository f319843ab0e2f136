// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "discovery/discovery.h"
#include "measurement/dataset.h"
#include "report/html/page.h"

namespace hexcal {

// A calibrated machine in space, at the pose nearest to the middle of those visited. Frame W, m.
struct Scene {
  std::string label;  // of that pose
  Pose3d world_from_base, world_from_platform, world_from_tool;
  std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>> legs;  // joints on base and platform
  std::vector<std::pair<std::string, Eigen::Vector3d>> markers;   // of bodies whose shape is known
  struct Arrow {
    std::string label;
    Eigen::Vector3d from, along;                 // the tool as predicted, and measured minus that
    std::optional<Eigen::Vector3d> before = {};  // with what discover started from
    bool used = true;                            // has a weight in the fit
  };
  std::vector<Arrow> arrows;                             // of every pose
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  // of the tool there, by the calibration
};

// observations: of the dataset, those that the estimate is of.
Scene MakeScene(const Dataset& dataset, const Observations& observations, const Estimate& estimate);
// Before and after.
Scene MakeScene(const Dataset& dataset, const Discovery& discovery);

// The machine: frames, legs, outlines, markers, poses. And nearer by, what is left over at every
// pose and the ellipsoid that holds the predicted tool with 95 %, both enlarged.
std::vector<Chart> SceneCharts(const Scene& scene);

}  // namespace hexcal
