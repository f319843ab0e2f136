// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "estimator/marker_observations.h"
#include "estimator/outliers.h"
#include "estimator/subset_fit.h"

namespace hexcal {

// One marker's mean reading in one pose against all other readings.
struct ReadingCheck {
  std::size_t item = 0;  // of the observations
  std::string marker;    // base/b1, tool/t2
  Eigen::Vector3d held_out =
      Eigen::Vector3d::Zero();  // measured - what the others predict, m, frame M
  double squared = 0.0;         // the same in squared sigmas: chi-square of 3
  double smallest = 0.0;    // the smallest error, along the worst direction, that would be found, m
  double redundancy = 0.0;  // the part of an error that shows in the residual, mean of the three
  double p_value = 1.0;     // that the worst of so many clean readings is as far off
  bool is_bad = false;      // significant; it has then no part in what the others predict
};

struct ReadingSearch {
  std::vector<ReadingCheck> checks;  // of those that the others check, pose by pose
  int unchecked = 0;                 // that no others check
  NoiseBasis basis = NoiseBasis::kStated;
  std::vector<ReadingCheck> Bad() const;  // worst first
};

struct ReadingOptions {
  double alpha = 0.01;  // that of all clean readings together one or more is called bad
  double power = 0.8;   // with which the smallest errors are found
  int threads = 1;
};

// Data snooping of single marker readings, three coordinates at a time: each is judged by what all
// others predict for it, at the level 1 - (1 - alpha)^(1/n) of n readings (Sidak), by chi-square
// for a stated noise and by F for one that is estimated or that the readings disprove (as
// FindOutliers does for poses). The worst goes out as long as it is significant, at most a tenth of
// all; then what is no longer so far off comes back. Where a pose contradicts the others
// (outliers) and not one bad reading is the reason, the robot's pose does not check its readings:
// the other markers of the same body do. near: mounts to start from. Reference: W. Baarda, A
// Testing Procedure for Use in Geodetic Networks (1968).
ReadingSearch FindBadReadings(const MarkerObservations& markers,
                              const BaseAndTool& near,
                              const std::vector<Outlier>& outliers,
                              const ReadingOptions& options);

// "tool/t2 in pose 17: 8.1 sigma off (0.5 mm)"; label: the pose's.
std::string ReadingWords(const ReadingCheck& reading, const std::string& label);

}  // namespace hexcal
