// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "measurement/dataset.h"
#include "model/effect.h"

namespace hexcal {

// What the effect of a fault of the data says of it, beside its name: numbers in `reference`, a
// word in `found`.
//   wrong_rotation_order    found order: zyx, the factors of the rotation, Rz(rz) Ry(ry) Rx(rx)
//   transposed_rotation     -
//   wrong_quaternion_order  -
//   swapped_legs            reference permutation: number i is the leg in the place of leg i
//   swapped_markers         index: two markers that have each other's name
//   shifted_rows            reference rows: the pose of a row stands so many rows further down
//   wrong_unit              reference factor: what makes it right; found of: lengths or angles
struct FaultKind {
  std::string_view name;
  std::string_view number;  // empty: none
  int size = 0;
  std::string_view word;                // empty: none
  std::vector<std::string_view> words;  // that it may be
};
// Null where no fault has this name.
const FaultKind* FindFaultKind(std::string_view name);

// The robot's rows as they should have been recorded: the faults among the effects mended one after
// another, in their order. Rows beyond the ends of the table: its first or last pose. hexapod: for
// swapped legs of recorded poses. InputError where legs in their own places reach no pose.
RobotPoses MendedRobotPoses(const RobotPoses& robot_poses,
                            const std::vector<Effect>& effects,
                            const HexapodGeometry* hexapod);

// The readings under the names that they should carry, faults mended one after another. InputError
// where a marker's number is beyond the bodies'. Measured poses stay as they are.
Measurement MendedMeasurement(const Measurement& measurement, const std::vector<Effect>& effects);

// The markers' names as they are read, markers from 0, base body first: reading m is of marker
// result[m].
std::vector<int> MarkersAsRead(const std::vector<Effect>& effects, int markers);

}  // namespace hexcal
