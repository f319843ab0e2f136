// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hidden/truth.h"

namespace hexcal::hidden {

// How the noise behaves. All but kUnderstated have the stated sigma as root mean square over the
// readings, apart from what is added by the robot or by outliers.
enum class Regime {
  kWhite,
  kHeavyTails,      // Student's t with 5 degrees of freedom, a marker's coordinate each
  kOutliers,        // one pose in twenty is off by 5 to 20 times what the tracker sees of a pose
  kRangeDependent,  // sigma grows threefold from the nearest pose to the farthest
  kUnderstated,     // the stated sigma is 20 % too small
  kVaryingScale,    // from pose to pose, log-normal 0.4
  kHalfRepeat,      // the robot misses its pose by half the tracker's sigma of a pose
  kFullRepeat,      // by one such sigma
  kSerial,          // from pose to pose with correlation 0.8
};

const std::vector<std::pair<Regime, std::string>>& Regimes();
std::optional<Regime> FindRegime(const std::string& name);

// Covariance of the tool's pose in the world as the tracker sees it, [m, rad], right twist in T, by
// the stated sigma, tracker pose free.
Eigen::Matrix<double, 6, 6> SeenPoseCovariance(const Scene& scene, const Row& row);

// The same of the platform's pose, right twist in A: what one sigma of the robot is measured in.
Eigen::Matrix<double, 6, 6> SeenPlatformCovariance(const Scene& scene, const Row& row);

// Of one row's reading: of outliers, of the scale that varies and of the correlation with other
// rows it knows nothing.
using ReadingCovariance = Eigen::Matrix<double, 24, 24>;
ReadingCovariance NoiseCovariance(const Scene& scene, const Row& row, Regime regime);

// The readings of the measured rows with noise.
std::vector<Reading> NoisyReadings(const Scene& scene,
                                   const std::vector<HiddenEffect>& effects,
                                   Regime regime,
                                   Dice* dice);

}  // namespace hexcal::hidden
