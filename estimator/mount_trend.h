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
  // Of a record in control being called out of it, by each of the two tests: Shewhart's 3 sigma.
  double alpha = 0.0027;
  int baseline =
      1;  // the first so many trusted records are in control whatever they say; at least 1
};

// One calibration against those before it.
struct TrendPoint {
  bool is_used = false;                    // trusted, and its covariance is definite
  std::optional<MountChange> step;         // since the used one before
  Vector12d position = Vector12d::Zero();  // this [-] the first used one, m and rad
  // Against the earlier ones that were in control: the chart's centre and half width, and
  // T^2 = e' V^-1 e of all 12, e = position - centre.
  bool is_judged = false;
  Vector12d centre = Vector12d::Zero(), half_width = Vector12d::Zero();
  double t_squared = 0.0, t_squared_limit = 0.0, p_value = 0.0;
  std::array<bool, 12> outside = {};  // beyond the half width
  bool is_in_control = true;
};

// A straight line through the positions, by generalised least squares.
struct MountDrift {
  Vector12d rate = Vector12d::Zero(), standard_deviation = Vector12d::Zero();  // m/s and rad/s
  // Of the deviations about the line over what the covariances let expect, at least 1 (Birge); the
  // standard deviations have it where it is significant (5 %).
  double birge_ratio = 1.0;
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

// A self-starting Shewhart chart of individuals (each record is judged by those before it) with the
// covariance of each record known, and the chi-square chart of the 12 together (Hotelling's T^2 of
// known covariance; Montgomery, Introduction to Statistical Quality Control, chapters 6 and 11).
// Where the earlier records scatter by more than their covariances explain (Cochran's Q, 5 %), the
// variance between records joins each parameter's by DerSimonian and Laird's moments (1986), and
// the limits become Student's t and 12 F(12, n - 1). Half widths share alpha between the 12
// (Bonferroni). A record out of control does not count for the later ones.
MountTrend TrendOf(const std::vector<DatedMounts>& records, const TrendOptions& options = {});

}  // namespace hexcal
