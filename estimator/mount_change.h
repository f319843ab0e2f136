// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "residuals/pose_error.h"

namespace hexcal {

// Base and tool as one calibration found them.
struct KnownMounts {
  BaseAndTool mounts;
  Matrix12d covariance = Matrix12d::Zero();
  std::array<bool, 12> determined = {};  // which of the 12 the data determine
};

// What has changed between two calibrations that share no reading. NaN where not determined.
struct MountChange {
  Vector12d difference = Vector12d::Zero();  // now [-] earlier, m and rad
  Vector12d sigmas = Vector12d::Zero();      // in standard deviations of the difference
  double chi_square = 0.0, p_value = 0.0;    // of all 12 together
};

// now [-] earlier of both mounts, the 12 of docs/conventions.md, m and rad.
Vector12d Minus(const BaseAndTool& now, const BaseAndTool& earlier);

// For changes whose rotations are small against a radian: the covariances simply add.
MountChange ChangeBetween(const KnownMounts& earlier, const KnownMounts& now);

}  // namespace hexcal
