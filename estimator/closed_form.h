// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "estimator/observations.h"
#include "residuals/pose_error.h"

namespace hexcal {

// Base and tool from nothing, right for any rotation; equal weights, no covariance. All solve the
// rotations first (Eq. 1 without translations: Q_i = R_base A_i R_tool) and the translations by
// linear least squares after that.
enum class ClosedForm {
  kShah,        // Kronecker product and SVD: M. Shah, J. Mechanisms Robotics 5 (2013)
  kParkMartin,  // rotation vectors of relative motions: Park and Martin, IEEE T-RA 10 (1994), here
                // for AX = YB
  kPositions,   // the base's rotation from the positions alone, as if the tool stood in A
};

BaseAndTool SolveClosedForm(ClosedForm method, const std::vector<Observation>& observations);

// The tool's rotation and both translations that fit best with this rotation of the base.
BaseAndTool CompleteBase(const std::vector<Observation>& observations,
                         const Eigen::Matrix3d& base_rotation);

}  // namespace hexcal
