// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "measurement/dataset.h"
#include "model/machine.h"

namespace hexcal {

struct SimulateOptions {
  std::uint64_t seed = 1;
  double noise = 1.0;  // factor on every stated sigma; 0 for none
  // Other draws, just as good, by a generator that is seeded in no time: for studies that simulate
  // by the thousand.
  bool quick = false;
};

// What the tracker would see of the dataset's robot poses if the machine, with all its effects,
// were the truth: the dataset with its measurement replaced, every marker seen in every pose. What
// drives an effect is taken as recorded.
//
// Markers (rigid bodies only) get the dataset's marker sigma along the tracker's axes,
// tracker.frames times a pose; measured poses get measurement.noise in frame T. robot_poses.noise
// moves the true platform away from the reported pose: in frame A, or by its leg lengths. A noise
// that is not stated is zero. The tracker stands at the dataset's tracker.pose, else at the
// machine's world_from_tracker, else in W. Leg lengths become poses by the machine's hexapod where
// it has one, else by the dataset's.
//
// A pose's draws depend on the seed and its label alone: six of the robot, then x, y, z of each
// marker (frame by frame, base before tool) or six of the measured pose. So any subset of the poses
// gets the same noise, and a factor on the noise scales it. InputError where the dataset lacks what
// this needs.
Dataset Simulate(const Dataset& dataset, const Machine& machine, const SimulateOptions& options);

}  // namespace hexcal
