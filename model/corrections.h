// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>

namespace hexcal {

// What effects add to the nominal machine in one visit, each at its own site. Zero: nothing.
// Corrections of several effects add up.
template <typename T>
struct Corrections {
  using Vector6 = Eigen::Matrix<T, 6, 1>;
  using Matrix36 = Eigen::Matrix<T, 3, 6>;

  Vector6 leg = Vector6::Constant(T(0));                // to the length that the controller
                                                        // reports, m
  Matrix36 base_joints = Matrix36::Constant(T(0));      // frame B, m
  Matrix36 platform_joints = Matrix36::Constant(T(0));  // frame A, m
  Vector6 base_twist = Vector6::Constant(T(0));         // right of world_from_base, [m, rad]
  Vector6 platform_twist = Vector6::Constant(T(0));     // right of base_from_platform
  Vector6 tool_twist = Vector6::Constant(T(0));         // right of platform_from_tool
  // The tracker reads a point p of its frame, right of which it stands tracker_twist away, as
  //   p + scale p + depth_scale (0, 0, z) + distortion (x^2 + y^2) (x, y, 0).
  T tracker_scale = T(0), tracker_depth_scale = T(0);
  T tracker_distortion = T(0);  // 1/m^2
  Vector6 tracker_twist = Vector6::Constant(T(0));
  // To the markers' coordinates in their bodies (base, tool), 3 x markers or 3 x 0, m.
  std::array<Eigen::Matrix<T, 3, Eigen::Dynamic>, 2> markers;
};

}  // namespace hexcal
