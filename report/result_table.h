// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>

#include "estimator/estimate.h"
#include "report/result_json.h"

namespace hexcal {

// The result for the terminal: both mounts in mm and mrad (Eq. 2's angles), each with one standard
// deviation of just that number, then how well it fits. UTF-8.
std::string ResultTable(const ResultHeader& header, const Estimate& estimate);

// d [x y z rx ry rz] / d (right perturbation of a_from_b); of no use for angles at the gimbal.
Matrix6d PoseVectorByMotion(const Pose3d& a_from_b);

// Of the 12, base and tool: whether each of Eq. (2)'s numbers is. A number is a mix of the three
// shifts or turns along the mount's own axes.
std::array<bool, 12> DeterminedNumbers(const Observability& observability);

// One standard deviation of [x y z rx ry rz] of a_from_b, m and rad, from the covariance of its
// right perturbation. The angles' are infinite where the gimbal is within three sigmas of the turn.
Vector6d PoseVectorSigma(const Pose3d& a_from_b, const Matrix6d& covariance);

}  // namespace hexcal
