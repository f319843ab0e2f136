// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "estimator/observations.h"
#include "residuals/pose_error.h"

namespace hexcal {

// Base and tool from nothing; equal weights, no covariance. All but Li's solve the rotations first
// (Eq. 1 without translations: Q_i = R_base A_i R_tool) and the translations by linear least
// squares after that. Shah's, Park-Martin's and Li's are right for any rotation.
enum class ClosedForm {
  kShah,        // Kronecker product and SVD: M. Shah, J. Mechanisms Robotics 5 (2013)
  kParkMartin,  // rotation vectors of relative motions: Park and Martin, IEEE T-RA 10 (1994), here
                // for AX = YB
  kLi,      // Kronecker product, rotations and translations in one linear problem: A. Li, L. Wang,
            // D. Wu, Int. J. Physical Sciences 5 (2010). Needs poses at more than one place,
            // and depends on where the origins are.
  kZhuang,  // quaternions, the paper's reference 14: H. Zhuang, Z. Roth, R. Sudhakar, IEEE T-RA
            // 10 (1994). Divides by the scalar part of the base's quaternion: loses its digits
            // as the base nears a half turn, and is wrong there. Signs: no pose turned by just a
            // half turn from the first.
  kPositions,  // the base's rotation from the positions alone, as if the tool stood in A
};

BaseAndTool SolveClosedForm(ClosedForm method, const std::vector<Observation>& observations);

// The tool's rotation and both translations that fit best with this rotation of the base.
BaseAndTool CompleteBase(const std::vector<Observation>& observations,
                         const Eigen::Matrix3d& base_rotation);

}  // namespace hexcal
