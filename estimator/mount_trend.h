// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "estimator/mount_change.h"

namespace hexcal {

// A calibration among others of the same machine.
struct DatedMounts {
  double time = 0.0;  // s
  KnownMounts known;
  bool is_trusted = true;  // false: listed, and left out of everything
};

struct TrendOptions {
  // Of a record in control being called out of it, by each test: Shewhart's 3 sigma.
  double alpha = 0.0027;
  // The first so many trusted records are in control whatever they say; at least 1.
  int baseline = 1;
  double moving_weight = 0.2;  // of the latest record in the moving mean
};

// Whether a deviation is one of chance.
struct ChartTest {
  Vector12d deviation = Vector12d::Zero(), half_width = Vector12d::Zero();  // m, rad
  std::array<bool, 12> outside = {};                                        // beyond the half width
  double t_squared = 0.0, t_squared_limit = 0.0, p_value = 1.0;             // of all 12
  bool is_in_control = true;
};

// One calibration against those before it.
struct TrendPoint {
  bool is_used = false;                    // trusted, and its covariance is definite
  std::optional<MountChange> step;         // since the used one before
  Vector12d position = Vector12d::Zero();  // this [-] the first used one, m and rad
  bool is_judged = false;                  // it comes after the baseline
  bool is_in_control = true;               // by both tests
  ChartTest level;                         // from the mean of the earlier ones in control
  // Of the moving mean from the mean of the baseline; not of a record that level calls out of
  // control, which the moving mean leaves out.
  ChartTest moving;
};

// A straight line through the positions, by generalised least squares.
struct MountDrift {
  Vector12d rate = Vector12d::Zero(), standard_deviation = Vector12d::Zero();  // m/s and rad/s
  // The records are off the line by more than their covariances explain (5 %): what is between
  // them joins each parameter's variance, and F(12, n - 2) takes the place of chi-square.
  bool scatter_shows = false;
  double statistic = 0.0, p_value = 0.0;  // of all 12 rates
};

struct MountTrend {
  std::vector<TrendPoint> points;  // one a record
  // Of the records in control.
  int in_control = 0;
  bool scatter_shows = false;  // they differ by more than their covariances explain (5 %)
  double homogeneity_p = 1.0;
  Vector12d between = Vector12d::Zero();  // standard deviation between records beyond those, m, rad
  std::optional<MountDrift> drift;        // of all used ones: three at least, not all at one time
};

// Two charts with the covariance of each record known. Jumps: a self-starting Shewhart chart of
// individuals (each record is judged by those before it) with the chi-square chart of the 12
// together (Hotelling's T^2 of known covariance; Montgomery, Introduction to Statistical Quality
// Control, chapters 6 and 11). Slow changes: the same limits for the exponentially weighted moving
// mean (Roberts 1959; of vectors Lowry et al. 1992). Where the earlier records, or those of the
// baseline, scatter by more than their covariances explain (Cochran's Q, 5 %), the variance between
// records joins each parameter's by DerSimonian and Laird's moments (1986), and the limits become
// Student's t and 12 F(12, n - 1). Half widths share alpha between the 12 (Bonferroni). A record
// out of control does not count for the later ones.
MountTrend TrendOf(const std::vector<DatedMounts>& records, const TrendOptions& options = {});

}  // namespace hexcal
