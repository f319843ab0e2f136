// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "estimator/certificate.h"
#include "estimator/covariance.h"
#include "estimator/intervals.h"
#include "estimator/observations.h"
#include "estimator/outliers.h"
#include "residuals/pose_error.h"

namespace hexcal {

// One step of an iterative solver; the first record is the start. RMS errors as in Eq. (42), m and
// rad.
struct IterationRecord {
  double cost = 0.0;  // half the sum of squared residuals that the solver minimises
  double rmspe = 0.0;
  double rmsoe = 0.0;
};

// What an iterative solver found for one set of weights.
struct Solution {
  BaseAndTool mounts;
  bool converged = false;
  std::string message;
  std::vector<IterationRecord> iterations;
};

// What a calibration by markers leaves of the mean reading of one marker in one pose.
struct MarkerMisfit {
  std::string marker;                                  // base/b1, tool/t2
  Eigen::Vector3d residual = Eigen::Vector3d::Zero();  // measured - predicted, m, frame M
};

struct PoseResult {
  std::string label;
  double weight = 1.0;
  Vector6d residual = Vector6d::Zero();  // measured [-] predicted, [m, rad], frame T, not whitened
  std::vector<MarkerMisfit> markers = {};  // of a calibration by markers
};

// On which side of the loop the noise is taken to be.
enum class NoiseSide { kTracker, kRobot, kBoth };
constexpr std::string_view NameOf(NoiseSide side) {
  return side == NoiseSide::kBoth ? "both" : side == NoiseSide::kRobot ? "robot" : "tracker";
}

struct NoiseSummary {
  double position = 0.0;     // 1-sigma of a coordinate, m: the mean over poses and axes
  double orientation = 0.0;  // rad
  bool estimated = false;
  // Of a calibration by markers: 1-sigma of one reading along the tracker's axes, m.
  std::optional<Eigen::Vector3d> marker = {};
  NoiseSide assumed = NoiseSide::kTracker;
};

// What least squares leaves of the poses of a fit, each by its noise alone.
struct NoiseMisfit {
  double chi_square = 0.0;
  int degrees_of_freedom = 0;
  double Scale() const { return std::sqrt(chi_square / degrees_of_freedom); }
};

// A calibration with all that judges it.
struct Estimate {
  BaseAndTool mounts;
  bool converged = false;
  std::string message;  // why it did not converge
  std::vector<IterationRecord> iterations;
  std::vector<PoseResult> poses;
  std::optional<Pose3d> tracker_from_world;  // of a tracker that stood still
  std::vector<Outlier> outliers;  // where they were sought; of weight 0 where they were rejected

  NoiseSummary noise;
  double noise_scale = 1.0;  // sqrt(chi_square / degrees_of_freedom)
  double rmspe = 0.0;        // m; of pose-vector differences for the paper's error, else of [-]
  double rmsoe = 0.0;        // rad
  double chi_square = 0.0;
  int degrees_of_freedom = 0;
  // Of a fit that weighs otherwise, under a loss or as the paper: chi_square has then another
  // distribution, and says nothing of the noise.
  std::optional<NoiseMisfit> least_squares = {};

  Matrix12d covariance_unscaled = Matrix12d::Zero();
  Matrix12d covariance = Matrix12d::Zero();  // the one to use
  Intervals intervals;                       // 95 %, of covariance
  Observability observability;               // which of the 12 are determined
  std::optional<Certificate> certificate;    // where asked for (Certify), not for equal weights
  std::vector<std::string> warnings;

  // False: the 12 parameters cannot be trusted (exit status 4).
  bool IsTrustworthy() const { return converged && observability.null_directions == 0; }

  // What a stated noise is to be judged by: chi-square of these degrees of freedom where it is
  // right.
  NoiseMisfit OfNoise() const {
    return least_squares.value_or(NoiseMisfit{chi_square, degrees_of_freedom});
  }
};

}  // namespace hexcal
