// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "config/input_error.h"
#include "config/units.h"
#include "geometry/pose.h"
#include "measurement/hexapod_geometry.h"

namespace hexcal {

// 1-sigma of a pose along the axes of its own (right-hand) frame: m and rad.
struct PoseNoise {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Vector3d orientation = Eigen::Vector3d::Zero();

  Matrix6d Covariance() const;
};

struct Covariate {
  std::string name;
  Unit unit;                   // as declared; values are in unit.si_symbol
  std::vector<double> values;  // one a robot pose
};

// One row of robot_poses. Poses stand in the order in which they were visited.
struct RobotPose {
  std::string label;
  Pose3d base_from_platform;                 // as reported; identity where only legs were recorded
  std::array<double, kNumLegs> leg_lengths;  // m; zero where a pose was recorded
  int line = 0;                              // in the table
};

struct RobotPoses {
  bool are_leg_lengths = false;
  std::vector<RobotPose> rows;
  std::vector<Covariate> covariates;
  std::optional<PoseNoise> noise;   // of the reported pose, in frame A
  std::optional<double> leg_noise;  // 1-sigma of a leg length, m
  Location where;                   // the table
};

enum class BodyId { kBase = 0, kTool = 1 };

// A rigid body that carries markers. Rigid: the markers' coordinates in the body's own frame are
// known. Centroid: the paper's Section 5.1, the frame is made of three markers; the shape is not
// known beforehand.
struct MarkerBody {
  bool is_centroid = false;
  std::vector<std::string> markers;
  Eigen::Matrix3Xd p_in_body;          // rigid: 3 x markers, m; centroid: 3 x 0
  std::array<int, 2> x_axis = {0, 1};  // centroid: from the first of these markers to the second
};

// One marker in one frame, as the tracker read it. Unseen markers have no reading.
struct MarkerReading {
  int pose;   // row of robot_poses
  int frame;  // which reading of this pose: an index into Measurement::frame_labels, 0 where the
              // column is absent
  BodyId body;
  int marker;                    // index in the body
  Eigen::Vector3d p_in_tracker;  // m
};

struct MeasuredPose {
  int pose;  // row of robot_poses
  Pose3d world_from_tool;
};

struct Measurement {
  enum class Kind { kPoses, kMarkers };
  Kind kind = Kind::kPoses;
  // kPoses
  std::vector<MeasuredPose> poses;
  std::optional<PoseNoise> pose_noise;
  // kMarkers
  std::array<MarkerBody, 2> bodies;  // by BodyId
  std::vector<MarkerReading> readings;
  std::vector<std::string> frame_labels;
  std::optional<Eigen::Vector3d> marker_sigma;  // along the axes of the tracker, m
  Location where;
};

struct Tracker {
  bool is_static = false;
  std::optional<Pose3d> tracker_from_world;  // T_W^M for simulation
  int frames = 1;                            // readings a pose for simulation
};

struct InitialGuess {
  Pose3d world_from_base;
  Pose3d platform_from_tool;
};

// A dataset as recorded, in SI (temperatures in degC). See docs/dataset.md.
struct Dataset {
  std::string path;  // of the YAML file, for messages
  std::string name;
  std::string description;
  std::optional<Eigen::Vector3d> gravity_in_base;  // unit vector
  std::optional<HexapodGeometry> hexapod;
  std::optional<double> reference_temperature;  // degC
  RobotPoses robot_poses;
  Tracker tracker;
  std::optional<Measurement> measurement;
  std::optional<InitialGuess> initial;
  std::vector<std::string> warnings;  // what looks odd but is allowed
};

// Reads the YAML file and its tables. InputError for everything docs/dataset.md calls bad.
// With needs_measurement, a file without one is refused; else its table of readings may be absent
// too (a plan).
Dataset ReadDataset(const std::string& path, bool needs_measurement);

}  // namespace hexcal
