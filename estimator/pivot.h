// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "estimator/pivot_solution.h"

namespace hexcal {

// What a pose says of the tip.
struct PivotRow {
  std::string label;
  int line = 0;
  bool used = true;
  Eigen::Vector3d residual;     // where the measured pose puts the tip less the pivot, frame W, m
  double squared_sigmas = 0.0;  // by its own noise; of three
};

// A pose that the others contradict.
struct PivotOutlier {
  std::size_t index = 0;  // among the poses
  double distance = 0.0;  // of the tip from the pivot of the others, m
  double sigmas = 0.0;    // the same, by noise and prediction
  double p_value = 0.0;   // that the worst of so many clean poses is as far off
};

// The tool's tip by pivoting: the tip rests in a divot while the tool is tilted about it.
struct PivotResult {
  TipAndPivot x;
  Matrix6d covariance =
      Matrix6d::Zero();  // of (tip in T, pivot in W), m^2; zero along what is lost
  Vector6d half_width = Vector6d::Zero();          // 95 % interval of each
  Vector6d degrees_of_freedom = Vector6d::Zero();  // of each variance
  double tip_degrees_of_freedom = 0.0;
  double tip_ellipsoid = 0.0;  // d' covariance^-1 d of the tip is not above it with 95 %
  Tilts tilts;
  double condition_number = 0.0;
  Eigen::Vector3d noise_tilts = Eigen::Vector3d::Zero();  // of tilts.directions, by noise, rad
  std::array<bool, 3> is_lost = {};  // of tilts.directions: the tip is not determined along it
  PivotNoise noise = PivotNoise::kUnknown;
  double noise_scale = 1.0;
  double position_noise = 0.0, orientation_noise = 0.0;  // kUnknown: estimated
  double rms = 0.0;                                      // of the residuals' lengths, used poses, m
  double chi_square = 0.0;                               // sum of squared sigmas
  int degrees_of_freedom_of_fit = 0;
  double chi_square_low = 0.0, chi_square_high = 0.0;  // 95 %
  int iterations = 0;
  bool converged = false;
  std::vector<PivotRow> rows;
  std::vector<PivotOutlier> outliers;
  std::vector<std::string> warnings;

  bool IsTrustworthy() const { return converged && lost_count() == 0; }
  // Whether the tip's coordinate has no share in a lost direction.
  bool IsDetermined(int axis) const;
  long lost_count() const { return std::count(is_lost.begin(), is_lost.end(), true); }
  bool NoiseIsStated() const { return noise == PivotNoise::kKnown; }
  // Whether chi-square tests the stated noise, and is above its limits.
  bool IsTested() const { return NoiseIsStated() && lost_count() == 0; }
  bool HasTooMuchLeftOver() const { return IsTested() && !(chi_square <= chi_square_high); }
  // Outliers that the tip rests on all the same.
  long used_outliers() const {
    return std::count_if(outliers.begin(), outliers.end(), [this](const PivotOutlier& outlier) {
      return rows[outlier.index].used;
    });
  }
};

// Three poses or more (CHECK).
PivotResult CalibratePivot(const PivotPoses& poses, const PivotOptions& options);

}  // namespace hexcal
