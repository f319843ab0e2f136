// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "estimator/observations.h"

namespace hexcal {

// A way to read the poses that a robot's file states.
struct RobotReading {
  std::string_view order;      // of three angles: geometry/rotation_order.h; empty: not of angles
  bool is_transposed = false;  // rotations the other way round
  int quaternion_shift =
      0;  // of numbers that were read as w x y z: 1: they are z w x y, 3: x y z w
  double angle_factor = 1.0;   // what the angles as read must be multiplied by
  double length_factor = 1.0;  // likewise
  bool is_inverse = false;     // what is stated is platform_from_base
};

// A robot's poses as they were read: x y z and three angles where its file states angles.
struct StatedPose {
  Pose3d base_from_platform;
  std::optional<Vector6d> vector;  // m and rad
};

// The tracker's side by one way to read its files.
struct MeasuredReading {
  std::vector<std::optional<Pose3d>> world_from_tool;  // by row, none where it was not measured
  int changes = 0;                                     // against the stated one
};

// A reading of both sides, and what base and tool leave over with it, RMS, m and rad.
struct ConventionFit {
  RobotReading robot;
  std::size_t measured = 0;  // index into the measured sides that were tried
  int changes = 0;           // against the stated one
  double rms_position = 0.0;
  double rms_orientation = 0.0;
};

struct Conventions {
  ConventionFit stated;
  ConventionFit best;  // of those that fit alike, the one with the fewest changes
  double gain = 1.0;   // how many times smaller the variances are, the mean of position and
                       // orientation in the logarithm; 1 where the stated one is best
  std::size_t tried = 0;
};

// Tries every order of the angles, sense, unit, quaternion order and inversion on the data.
// poses: of the robot, by row, as the reading stated made of them (before any inversion);
// measured: the first is the stated one. At most 100 rows, spread over all, are looked at. Nothing
// where fewer than six are there.
std::optional<Conventions> TryConventions(const std::vector<StatedPose>& poses,
                                          const std::vector<MeasuredReading>& measured,
                                          const RobotReading& stated);

// From where on another convention is worth a word.
inline constexpr double kClearGain = 10.0;

}  // namespace hexcal
