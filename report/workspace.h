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
  bool is_stated = false;   // else what the calibration's poses span
  bool is_measured = true;  // the poses reach to its ends, but for a twentieth of its width

  Vector6d Centre() const;
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

// "x 10 mm, y -20 mm, z 230 mm, rx 0 mrad, ry 140 mrad, rz 140 mrad"
std::string WordsOf(const Place& place);

}  // namespace hexcal
