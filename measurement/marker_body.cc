// SPDX-License-Identifier: BSD-3-Clause
#include "measurement/marker_body.h"

#include <Eigen/LU>

namespace hexcal {
namespace {

// Derivative of the frame's right perturbation by the markers' coordinates along the frame's own
// axes, 6 x 9. The markers lie in the plane z = 0 of the frame and their centroid is its origin.
Eigen::Matrix<double, 6, 9> FrameJacobian(const Eigen::Matrix3d& p_in_body,
                                          const std::array<int, 2>& x_axis) {
  Eigen::Matrix<double, 6, 9> jacobian = Eigen::Matrix<double, 6, 9>::Zero();
  // Out of the plane: w_k = dz + wx y_k - wy x_k, three equations for the lift and the two tilts.
  Eigen::Matrix3d plane;
  for (int k = 0; k < 3; ++k) plane.row(k) << 1.0, p_in_body(1, k), -p_in_body(0, k);
  const Eigen::Matrix3d tilt_from_lift = plane.inverse();
  for (int k = 0; k < 3; ++k) {
    jacobian.block<3, 3>(0, 3 * k) = Eigen::Matrix3d::Identity() / 3.0;
    jacobian(3, 3 * k + 2) = tilt_from_lift(1, k);
    jacobian(4, 3 * k + 2) = tilt_from_lift(2, k);
  }
  const double length = (p_in_body.col(x_axis[1]) - p_in_body.col(x_axis[0])).norm();
  jacobian(5, 3 * x_axis[1] + 1) = 1.0 / length;
  jacobian(5, 3 * x_axis[0] + 1) = -1.0 / length;
  return jacobian;
}

}  // namespace

Alignment CentroidFrame(const Eigen::Matrix3d& p_in_tracker,
                        const Eigen::Matrix3d& sigma_in_tracker,
                        const std::array<int, 2>& x_axis) {
  const Eigen::Vector3d origin = p_in_tracker.rowwise().mean();
  const Eigen::Vector3d m1 = p_in_tracker.col(0);
  Eigen::Matrix3d axes;
  axes.col(2) = (p_in_tracker.col(1) - m1).cross(p_in_tracker.col(2) - m1).normalized();
  // In the markers' plane already, so orthogonal to z but for rounding.
  const Eigen::Vector3d along = p_in_tracker.col(x_axis[1]) - p_in_tracker.col(x_axis[0]);
  axes.col(0) = (along - axes.col(2) * axes.col(2).dot(along)).normalized();
  axes.col(1) = axes.col(2).cross(axes.col(0));

  Alignment frame;
  frame.a_from_b = MakePose(axes, origin);
  const Eigen::Matrix3d p_in_body = axes.transpose() * (p_in_tracker.colwise() - origin);
  const Eigen::Matrix<double, 6, 9> jacobian = FrameJacobian(p_in_body, x_axis);
  for (int k = 0; k < 3; ++k) {
    const Eigen::Matrix<double, 6, 3> by_reading =
        jacobian.block<6, 3>(0, 3 * k) * axes.transpose() * sigma_in_tracker.col(k).asDiagonal();
    frame.covariance += by_reading * by_reading.transpose();
  }
  return frame;
}

}  // namespace hexcal
