// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "estimator/estimate.h"
#include "measurement/dataset.h"
#include "report/pose_residuals.h"

namespace hexcal {

// What a calibration by markers leaves of one marker.
struct MarkerLeftOver {
  std::string label;  // base/b1
  int poses = 0;      // in which it was seen and used
  // Of one coordinate of its mean reading in a pose, m: as found, and what the noise explains (less
  // than the noise: each pose's fit takes a part).
  double rms = 0.0, expected = 0.0;
  // Measured minus predicted, axes of frame M, m, and the pose, an index into Estimate::poses; the
  // rejected poses' too.
  std::vector<Eigen::Vector3d> residuals;
  std::vector<std::size_t> pose_of_residual;
  std::vector<bool> used;  // false: of a rejected pose
};

// What is left over, beside what the estimate itself says of it.
struct LeftOver {
  PoseResiduals poses;
  std::vector<MarkerLeftOver> markers;  // empty unless the calibration is by markers
};

// observations: of the dataset, those that the estimate is of.
LeftOver MakeLeftOver(const Dataset& dataset,
                      const Observations& observations,
                      const Estimate& estimate);

}  // namespace hexcal
