// SPDX-License-Identifier: BSD-3-Clause
#include "residuals/pose_error.h"

namespace hexcal {

Vector6d PoseError(const BaseAndTool& mounts,
                   const Pose3d& base_from_platform,
                   const Pose3d& measured_world_from_tool) {
  return Minus(measured_world_from_tool,
               mounts.world_from_base * base_from_platform * mounts.platform_from_tool);
}

Matrix6x12d PaperJacobian(const Pose3d& base_from_tool) {
  Matrix6x12d jacobian;
  jacobian << InverseAdjoint(base_from_tool), Matrix6d::Identity();
  return jacobian;
}

Matrix6x12d PoseErrorJacobian(const Vector6d& pose_error, const Pose3d& base_from_tool) {
  // The predicted pose moves by p on its right: the error's translation turns with it, its rotation
  // loses p through Log.
  const Eigen::Vector3d translation = pose_error.head<3>();
  const Eigen::Vector3d turn = pose_error.tail<3>();
  Matrix6d by_prediction = Matrix6d::Zero();
  by_prediction.topLeftCorner<3, 3>() = -Eigen::Matrix3d::Identity();
  by_prediction.topRightCorner<3, 3>() = Skew(translation);
  by_prediction.bottomRightCorner<3, 3>() = -LeftJacobianInverse(turn);
  return by_prediction * PaperJacobian(base_from_tool);
}

}  // namespace hexcal
