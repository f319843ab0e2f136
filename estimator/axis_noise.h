// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>

#include "estimator/marker_observations.h"

namespace hexcal {

// What rigid bodies of known shape tell of the markers' noise, each fitted to its own readings of
// one pose: of the machine and its errors nothing is in it.
struct AxisNoise {
  Eigen::Vector3d sigma;        // of one reading along the tracker's axes, m
  Eigen::Matrix3d spread;       // covariance of the logarithms of their squares
  double likelihood_ratio = 0;  // twice its logarithm, against one sigma for all axes

  // With which each axis' sigma is known, the others' being unknown too.
  Eigen::Vector3d DegreesOfFreedom() const;
  // More than chance has it, once in a thousand.
  bool AxesDiffer() const;
};

// By restricted maximum likelihood: of n markers 3 n - 6 numbers are left over of every body and
// pose (Searle, Casella, McCulloch, Variance Components (1992), ch. 6), and repeated frames count
// with their scatter. Readings of a body that its own shape contradicts are left out. Nothing
// where an axis is told by no residual.
std::optional<AxisNoise> NoiseWithinBodies(const MarkerObservations& markers);

}  // namespace hexcal
