// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ceres/manifold.h>

#include "geometry/pose.h"

namespace hexcal {

// Ceres's view of Plus and Minus of geometry/pose.h: 7 parameters [tx ty tz qx qy qz qw], 6 degrees
// of freedom [m, rad], right perturbation, full angle.
class PoseManifold final : public ceres::Manifold {
 public:
  int AmbientSize() const override { return Pose3d::kNumParameters; }
  int TangentSize() const override { return Pose3d::kNumDof; }
  bool Plus(const double* x, const double* delta, double* x_plus_delta) const override;
  bool PlusJacobian(const double* x, double* jacobian) const override;  // 7 x 6, row-major
  bool Minus(const double* y, const double* x, double* y_minus_x) const override;
  bool MinusJacobian(const double* x, double* jacobian) const override;  // 6 x 7, row-major
};

}  // namespace hexcal
