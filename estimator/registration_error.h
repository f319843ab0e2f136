// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace hexcal {

// What one reading of a rigid body with markers is worth, in closed form: n markers, each read with
// the same 1-sigma along every axis, m, and fitted to their known coordinates with equal weights.
// Root mean square lengths, m. Independent of the pose of the body. Reference: J. M. Fitzpatrick,
// J. B. West, C. R. Maurer, IEEE Trans. Medical Imaging 17 (1998), Eqs. (10) and (46).

// The misfit of the markers (FRE). It says nothing about the error elsewhere.
double FiducialRegistrationError(Eigen::Index markers, double sigma);

// The error of a point of the body (TRE). p_in_body: 3 x n, n from 3, not collinear.
double TargetRegistrationError(const Eigen::Matrix3Xd& p_in_body,
                               double sigma,
                               const Eigen::Vector3d& target_in_body);

}  // namespace hexcal
