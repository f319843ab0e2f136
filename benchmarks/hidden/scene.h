// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "hidden/dice.h"
#include "hidden/legs.h"
#include "hidden/motion.h"

namespace hexcal::hidden {

using Markers = Eigen::Matrix<double, 3, 4>;

// One visited pose: what a user would have on record, and where the tracker stood.
struct Row {
  std::string label;
  Six vector;                 // Eq. (2) of what the controller reports
  Motion base_from_platform;  // the same
  double time = 0.0;          // s
  double temperature = 0.0;   // degC
  double payload = 0.0;       // kg
  Eigen::Vector3d payload_centre = Eigen::Vector3d::Zero();  // frame A, m
  Six velocity = Six::Zero();                                // of A in frame A, [m/s, rad/s]
  Six lengths = Six::Zero();                                 // that the controller reports
  Six last_move = Six::Zero();  // lengths minus those of the row before, or of home
  bool is_measured = false;     // else visited only; its tool pose is held out
  Motion tracker_from_world;
};

// A machine, its tracker and what was done with them. All that a dataset tells, and the mounts,
// which it does not tell.
struct Scene {
  Hexapod hexapod;
  bool tells_axes = false, tells_home = false;
  bool tells_velocity = false, tells_direction = false, tells_payload_centre = false;
  Six home_vector;
  Motion home;
  Eigen::Vector3d gravity;  // unit vector in B
  double reference_temperature = 0.0;
  std::vector<Row> rows;
  Motion world_from_base, platform_from_tool;
  Markers base_markers, tool_markers;  // in W and T
  bool tracker_is_static = false;
  Eigen::Vector3d sigma;  // of a marker's coordinate in the tracker, m

  int MeasuredRows() const;
  double FirstTime() const { return rows.front().time; }
  double TimeSpan() const { return rows.back().time - rows.front().time; }
};

enum class Size { kAny, kSmall, kLarge };

struct SceneOptions {
  Size size = Size::kAny;
  int measured = 0;         // 0: 60 to 72
  int visited_only = 60;    // held out
  double sigma = 0.0;       // m across the line of sight (along it twice that); 0: 3 to 150 um
  bool is_static = false;   // the tracker
  bool is_extreme = false;  // the payload hangs far out, so that leg forces change their sign
  bool has_velocity = false;
  bool has_axes = false;
};

Scene DrawScene(const SceneOptions& options, Dice* dice);

}  // namespace hexcal::hidden
