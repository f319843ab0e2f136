// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <string_view>

namespace hexcal {

// What three angles of a file may mean: the factors of the rotation from left to right, by their
// axes. "xyz" is Rx Ry Rz, Eq. (2) of the paper: turns about x, the new y and the newest z; the
// same turns about fixed axes in the opposite order.
inline constexpr std::array<std::string_view, 12> kRotationOrders = {
    "xyz", "xzy", "yxz", "yzx", "zxy", "zyx", "xyx", "xzx", "yxy", "yzy", "zxz", "zyz"};

bool IsRotationOrder(std::string_view order);

// order: one of kRotationOrders. angles, rad: by axis, [about x, about y, about z], where the order
// has all three axes; else in the order of the factors.
Eigen::Matrix3d RotationByOrder(std::string_view order, const Eigen::Vector3d& angles);

}  // namespace hexcal
