// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ceres/autodiff_cost_function.h>

#include "geometry/pose.h"

namespace hexcal {

// Measured against predicted tool pose (Eq. 1), whitened, dimensionless:
//   predicted = world_from_base * base_from_platform * platform_from_tool
//   residual  = whitener * (measured [-] predicted)          [m, rad] in frame T, before whitening
// Parameter blocks: world_from_base, platform_from_tool, 7 each, on PoseManifold.
class PoseResidual {
 public:
  PoseResidual(const Pose3d& base_from_platform,
               const Pose3d& measured_world_from_tool,
               const Matrix6d& whitener)
      : base_from_platform_(base_from_platform),
        measured_world_from_tool_(measured_world_from_tool),
        whitener_(whitener) {}

  static ceres::CostFunction* Create(const Pose3d& base_from_platform,
                                     const Pose3d& measured_world_from_tool,
                                     const Matrix6d& whitener) {
    return new ceres::AutoDiffCostFunction<PoseResidual, 6, 7, 7>(
        new PoseResidual(base_from_platform, measured_world_from_tool, whitener));
  }

  template <typename T>
  bool operator()(const T* base, const T* tool, T* residual) const {
    const Pose<T> predicted = Pose<T>::FromParameters(base) * base_from_platform_.Cast<T>() *
                              Pose<T>::FromParameters(tool);
    Eigen::Map<Eigen::Matrix<T, 6, 1>>{residual} =
        whitener_.cast<T>() * Minus(measured_world_from_tool_.Cast<T>(), predicted);
    return true;
  }

 private:
  Pose3d base_from_platform_;
  Pose3d measured_world_from_tool_;
  Matrix6d whitener_;
};

}  // namespace hexcal
