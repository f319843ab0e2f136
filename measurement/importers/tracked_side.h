// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "measurement/importers/recording.h"

namespace hexcal {

// What one recording has of the base's body or of the tool's.
struct TrackedSide {
  bool is_tracker = false;             // the base is the tracker itself: no body
  const RecordedBody* body = nullptr;  // with poses; nullptr: only markers
  std::vector<int> markers;            // indices into Recording::markers
  std::string name;                    // as the file calls it
};

// wanted: a body's name or alias, or names of markers "A,B,C"; for the base also "tracker". Empty:
// where the recording has but one body and no other markers that is the tool, and the base is the
// tracker. InputError names the flag and what there is.
TrackedSide ChooseSide(const Recording& recording, const std::string& wanted, bool is_base);

// InputError where a body or marker of the side is absurdly far away: CheckPlace.
void CheckPlaces(const Recording& recording, const TrackedSide& side);

// A name as a table's cell can carry it.
std::string CleanLabel(std::string_view name);

}  // namespace hexcal
