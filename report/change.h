// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "estimator/estimate.h"
#include "report/earlier_result.h"
#include "report/readings.h"
#include "report/requirement.h"

namespace hexcal {

// What has changed since an earlier calibration. NaN where not determined, and where both used the
// same readings of a pose or one is of exact data: then the covariance of the difference is not the
// sum of theirs.
struct Change {
  EarlierResult earlier;
  SharedReadings shared;
  bool is_of_exact = false;  // only rounding was left over by one of them
  bool IsTested() const { return shared.poses == 0 && !is_of_exact; }
  Vector12d difference = Vector12d::Zero();  // new [-] earlier, m and rad
  Vector12d sigmas = Vector12d::Zero();      // in standard deviations of the difference
  double chi_square = 0.0, p_value = 0.0;    // of all 12
  Vector12d over_own = Vector12d::Zero();    // in standard uncertainties of the new one: a size, no
                                             // test
  std::vector<double> at_points;             // how far the named points have moved at the centre, m
  std::vector<double> sigma_at_points;       // one standard deviation of that, m
};

// readings: of the dataset of now; may be empty. centre: a T_A^B.
Change ChangeOf(const EarlierResult& earlier,
                const Estimate& now,
                const DatasetReadings& readings,
                const std::vector<NamedPoint>& points,
                const Pose3d& centre);

// "50 of the 60 poses ...", a sentence on what the two calibrations have in common and what that
// means for the change.
std::string WordsOf(const SharedReadings& shared);
// Why nothing is tested then.
inline constexpr const char* kOfExactData =
    "in one of the two only the rounding of the numbers is left over: nothing is known of its "
    "noise";

}  // namespace hexcal
