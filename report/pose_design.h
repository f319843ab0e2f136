// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "estimator/observations.h"
#include "measurement/dataset.h"
#include "report/html/page.h"
#include "report/workspace.h"

namespace hexcal {

// Where the measured poses lie, and how much they turn: what a calibration can tell hangs on both.
struct PoseDesign {
  std::vector<std::string> labels;
  std::vector<Vector6d> poses;                // Eq. (2) of T_A^B, m and rad
  std::array<std::array<double, 2>, 6> span;  // of poses
  // Of a known hexapod: every leg's length in every pose, from and to, and what is allowed, m.
  std::vector<Vector6d> legs;
  std::array<std::array<double, 2>, 6> leg_span;
  std::optional<std::array<double, 2>> leg_limits;
  // From the mean orientation to each pose's, rotation vectors along the axes of the mean frame A,
  // rad; and by how much, RMS, about their three main axes, largest first. Column k of main_axes.
  std::vector<Eigen::Vector3d> rotations;
  Eigen::Vector3d rotation_rms;
  Eigen::Matrix3d main_axes;
  // The largest angle between the axes of two rotations of the larger half, rad, at most a right
  // angle.
  double angle_between_axes = 0.0;
};
PoseDesign PoseDesignOf(const Dataset& dataset, const Observations& observations);

// The poses along each coordinate and each leg against the workspace and the legs' limits; and the
// rotations.
std::vector<Chart> PoseDesignCharts(const PoseDesign& design, const Workspace& workspace);

}  // namespace hexcal
