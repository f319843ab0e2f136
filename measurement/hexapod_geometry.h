// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

#include "config/strict_yaml.h"
#include "config/units.h"
#include "geometry/pose.h"

namespace hexcal {

inline constexpr int kNumLegs = 6;
using Matrix36d = Eigen::Matrix<double, 3, kNumLegs>;

// What a dataset or a model file says of the hexapod; model/hexapod.h computes with it. Column i is
// leg i+1, m.
struct HexapodGeometry {
  Matrix36d base_joints_in_base = Matrix36d::Zero();
  Matrix36d platform_joints_in_platform = Matrix36d::Zero();
  std::optional<Matrix36d> base_axes_in_base;          // unit vectors; default: radial
  std::optional<Matrix36d> platform_axes_in_platform;  // likewise
  std::optional<Eigen::Vector2d> leg_limits;           // min, max, m
  std::optional<Pose3d> home;                          // centre of the travel, base_from_platform
  // home as six numbers of Eq. (2), m and rad, where a file gave it so: angles found from a pose
  // seldom give the pose to the last bit, these do.
  std::optional<Vector6d> home_vector;
};

// The mapping under the key hexapod:, its numbers in the given units. InputError for joints that
// coincide or are collinear.
HexapodGeometry ReadHexapodGeometry(const YamlNode& node, const Units& units);

// The same mapping as text, in m and rad, to the last bit; every line starts with indent.
std::string WriteHexapodGeometry(const HexapodGeometry& geometry, const std::string& indent);

// {xyz: [..], quaternion: [w,x,y,z]} or {xyz: [..], rpy: [rx,ry,rz]} (Eq. 2), in the given units. A
// quaternion within 1e-3 of unit length is normalised (one that is unit to rounding is kept to the
// last bit), others are refused.
Pose3d ReadPose(const YamlNode& node, const Units& units, std::string_view what);

// "{xyz: [..], quaternion: [w, x, y, z]}" in m, to the last bit.
std::string WritePose(const Pose3d& pose);

}  // namespace hexcal
