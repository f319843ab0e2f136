// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "geometry/pose.h"

namespace hexcal {

// A body that carries markers, as the likelihood of their readings sees it. A centroid body
// (paper, Section 5.1) has three markers and a shape of three unknowns that is the same in all
// poses: the markers a and b of x_axis lie at ((-+length - x) / 2, -y / 2, 0), the third at
// (x, y, 0), so that the centroid is the origin and b lies from a along x.
struct MarkerShape {
  Eigen::Matrix3Xd p_in_body;  // 3 x markers, m; centroid: where the shape starts
  bool is_centroid = false;
  std::array<int, 2> x_axis = {0, 1};

  // Of a centroid body: [length, x, y] of p_in_body, m.
  Eigen::Vector3d Parameters() const;
  // d(p of a marker of a centroid body) / d[length, x, y]; constant, and p is that times [length,
  // x, y].
  Eigen::Matrix3d ByParameters(int marker) const;
  Eigen::Matrix3Xd FromParameters(const Eigen::Vector3d& parameters) const;
};

// The mean of a marker's readings in one pose; its sigma is that of one reading over the root of
// their number.
struct MarkerMean {
  int marker = 0;  // in its body
  int frames = 1;
  Eigen::Vector3d p_in_tracker = Eigen::Vector3d::Zero();  // m
};

// What was read of one robot pose: readings[first_base, first_tool) of the base body and
// readings[first_tool, end) of the tool body. Of a body at least three markers, not collinear;
// under a static tracker either body may be absent.
struct MarkerPose {
  Pose3d base_from_platform;  // as reported
  // L with C = L L' of the reported pose in frame A; zero where the robot is exact. May be
  // singular.
  Matrix6d robot_root = Matrix6d::Zero();
  Pose3d tracker_from_world;  // where the search for the best one starts
  Pose3d world_from_tool;     // as the bodies' frames tell it, for the record of iterations
  int first_base = 0, first_tool = 0, end = 0;
};

// The raw readings of a dataset, ready for a likelihood.
struct MarkerData {
  std::array<MarkerShape, 2> bodies;  // base, tool
  bool tracker_is_static = false;     // one tracker_from_world for all poses, of poses[0]
  bool has_robot_noise = false;
  std::vector<MarkerPose> poses;
  std::vector<MarkerMean> readings;
};

// A point in the space of all that is common to the poses.
struct MarkerUnknowns {
  Pose3d world_from_base, platform_from_tool;
  Pose3d tracker_from_world;                  // static tracker only
  std::array<Eigen::Matrix3Xd, 2> p_in_body;  // base, tool
};

// The parameter blocks of these unknowns: world_from_base, platform_from_tool, tracker_from_world
// of a static tracker (7 each), [length, x, y] of each centroid body (3). Offsets are in tangent
// space, -1 where there is none.
struct MarkerLayout {
  explicit MarkerLayout(const MarkerData& data);

  static constexpr int kMaxSize = 24;
  int tracker = -1;
  std::array<int, 2> shape = {-1, -1};
  int size = 12;
  std::vector<int> block_sizes = {Pose3d::kNumParameters, Pose3d::kNumParameters};

  MarkerUnknowns Unknowns(const MarkerData& data, double const* const* parameters) const;
  // The start of data with these mounts, a vector a block.
  std::vector<Eigen::VectorXd> Start(const MarkerData& data,
                                     const Pose3d& world_from_base,
                                     const Pose3d& platform_from_tool) const;
};

}  // namespace hexcal
