// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "geometry/pose.h"

namespace hexcal {

using Matrix6x12d = Eigen::Matrix<double, 6, 12>;
using Vector12d = Eigen::Matrix<double, 12, 1>;
using Matrix12d = Eigen::Matrix<double, 12, 12>;

// The 12 unknowns of a calibration.
struct BaseAndTool {
  Pose3d world_from_base;
  Pose3d platform_from_tool;
};

// Measured [-] predicted tool pose, [m, rad] in frame T, not whitened.
Vector6d PoseError(const BaseAndTool& mounts,
                   const Pose3d& base_from_platform,
                   const Pose3d& measured_world_from_tool);

// The paper's J of Eqs. (16)-(21): d(predicted world_from_tool) / d[d_b, delta_b, d_a, delta_a],
// where U of Eq. (8) is base_from_platform * platform_from_tool.
Matrix6x12d PaperJacobian(const Pose3d& base_from_tool);

// The exact derivative of PoseError by the right perturbations of both mounts: -D J with J as
// above, D = 1 at a perfect fit.
Matrix6x12d PoseErrorJacobian(const Vector6d& pose_error, const Pose3d& base_from_tool);

}  // namespace hexcal
