// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "config/input_error.h"
#include "measurement/dataset.h"

namespace hexcal {

// 'text' for a message: shortened when long, control characters replaced.
std::string Quoted(std::string_view text);

// What a measurement of a pose that is not known should have been.
inline constexpr const char* kKnownPose =
    "a pose that robot_poses lists (labels are compared as text)";

// Labels (of poses, markers, frames and covariates) are text that a CSV cell can carry: not empty,
// no comma, quote, line break or other control character, no leading '#', no blanks at the ends.
// what: for the message ("pose label").
void CheckLabel(std::string_view text, const Location& where, std::string_view what);

// From a pose's label to its row. Refers to the labels in rows, which must outlive it unmoved.
class PoseIndex {
 public:
  // InputError for a label that stands twice, with both lines.
  explicit PoseIndex(const RobotPoses& robot_poses);

  // The row, or -1. Rows of one pose usually stand together and poses in the same order in both
  // tables, so the last answer and the one after it are tried first.
  int Find(std::string_view label);

 private:
  // Open addressing, at most half full: a million labels take one allocation.
  struct Slot {
    std::size_t hash = 0;
    int row = -1;
  };
  // That of the label, or the empty one where it belongs.
  Slot& SlotOf(std::string_view label, std::size_t hash);

  const std::vector<RobotPose>& rows_;
  std::vector<Slot> slots_;  // a power of two
  int last_row_ = -1;
};

}  // namespace hexcal
