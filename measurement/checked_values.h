// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "config/input_error.h"

namespace hexcal {

// Numbers that a file states of a rotation or a direction, accepted when they are one within 1e-3
// and then made exact. What is unit to rounding (|v|^2 within 8 epsilon of 1) is kept to the last
// bit, so that a file that hexcal wrote reads back unchanged. Each throws InputError at where.

// Hamilton quaternion, scalar first.
Eigen::Quaterniond CheckedQuaternion(const Eigen::Vector4d& wxyz, const Location& where);
// The nearest rotation; determinant and orthogonality must hold within 1e-3.
Eigen::Matrix3d CheckedRotation(const Eigen::Matrix3d& matrix, const Location& where);
// A direction of any length but zero. what: for the message ("gravity").
Eigen::Vector3d CheckedDirection(const Eigen::Vector3d& direction,
                                 const Location& where,
                                 std::string_view what);

// No tracker or robot states more than this, m, but some have such numbers for what they did not
// see; squares of them leave the range of numbers.
inline constexpr double kLongestLength = 1e6;

// Whether points (3 x n) lie on one line, or in one place, to a thousandth of their extent.
bool AreCollinear(const Eigen::Matrix3Xd& points);

}  // namespace hexcal
