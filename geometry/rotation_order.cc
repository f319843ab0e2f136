// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/rotation_order.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace hexcal {

bool IsRotationOrder(std::string_view order) {
  return std::find(kRotationOrders.begin(), kRotationOrders.end(), order) != kRotationOrders.end();
}

Eigen::Matrix3d RotationByOrder(std::string_view order, const Eigen::Vector3d& angles) {
  const bool has_all_axes = order[0] != order[2];
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  for (int i = 0; i < 3; ++i) {
    const int axis = order[static_cast<std::size_t>(i)] - 'x';
    const double angle = angles[has_all_axes ? axis : i];
    rotation *= Eigen::AngleAxisd(angle, Eigen::Vector3d::Unit(axis)).toRotationMatrix();
  }
  return rotation;
}

}  // namespace hexcal
