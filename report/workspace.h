// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>
#include <vector>

#include "estimator/grown_target.h"
#include "estimator/observations.h"
#include "measurement/dataset.h"

namespace hexcal {

// Where accuracy is judged: ranges of the six numbers of Eq. (2) of T_A^B, m and rad.
struct Workspace {
  std::array<std::array<double, 2>, 6> box{};
  std::array<std::array<double, 2>, 6> measured{};  // what the calibration's poses span
  bool is_stated = false;                           // else it is what they span

  Vector6d Centre() const;
  // The poses reach to the ends of this number's range, but for a twentieth of its width.
  bool IsMeasured(int number) const;
  bool IsMeasured() const;
};

// A place in it.
struct Place {
  std::string label;  // of a pose of the dataset; empty: of the grid
  Pose3d base_from_platform;
  int row = GrownTarget::kNoRow;  // of the dataset's, where effects ask for it
};

Workspace MakeWorkspace(const std::optional<std::array<std::array<double, 2>, 6>>& stated,
                        const Observations& observations);

// The ends and the middle of every range, 3^6 places. Where the dataset says how long the legs may
// be and they do not reach a place, the farthest that they reach on the way to it from the centre:
// the edge of their reach is among the places. Empty where the centre is beyond their reach.
std::vector<Place> GridOf(const Workspace& workspace, const Dataset& dataset);

// The poses of the calibration.
std::vector<Place> PosesOf(const Observations& observations);

// Whether the legs reach it; true where nothing is known of them.
bool IsReached(const Dataset& dataset, const Pose3d& base_from_platform);

// "x (-14.2 to 13.9 mm measured), rz (-3 to 3° measured)": where it goes beyond all poses; empty
// where it does not.
std::string BeyondPoses(const Workspace& workspace);

// "x 10 mm, y -20 mm, z 230 mm, rx 0°, ry 8°, rz 8°"
std::string WordsOf(const Place& place);

}  // namespace hexcal
