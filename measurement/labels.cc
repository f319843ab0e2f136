// SPDX-License-Identifier: BSD-3-Clause
#include "measurement/labels.h"

#include <fmt/format.h>

#include <functional>

#include "config/utf8.h"

namespace hexcal {
namespace {

bool CsvCanCarry(std::string_view text) {
  if (text.front() == '#' || text.front() == ' ' || text.back() == ' ') return false;
  return text.find_first_of(",\"") == text.npos && !HasControls(text);
}

}  // namespace

std::string Quoted(std::string_view text) { return fmt::format("'{}'", Shorten(text)); }

void CheckLabel(std::string_view text, const Location& where, std::string_view what) {
  if (text.empty()) throw InputError(where, fmt::format("an empty {}", what), "some text");
  if (CsvCanCarry(text)) return;
  throw InputError(where,
                   fmt::format("the {} {}", what, Quoted(text)),
                   "text without commas, double quotes, line breaks or other control characters, a "
                   "leading '#' or blanks at its ends, which a table cannot carry");
}

PoseIndex::PoseIndex(const RobotPoses& robot_poses) : rows_(robot_poses.rows) {
  std::size_t size = 2;
  while (size < 2 * rows_.size()) size *= 2;
  slots_.resize(size);
  for (std::size_t row = 0; row < rows_.size(); ++row) {
    const RobotPose& pose = rows_[row];
    const std::size_t hash = std::hash<std::string_view>()(pose.label);
    Slot& slot = SlotOf(pose.label, hash);
    if (slot.row >= 0)
      throw InputError({robot_poses.where.file, pose.line, 0},
                       fmt::format("the pose label {} a second time", Quoted(pose.label)),
                       fmt::format("every label once (the first is in line {})",
                                   rows_[static_cast<std::size_t>(slot.row)].line));
    slot = {hash, static_cast<int>(row)};
  }
}

PoseIndex::Slot& PoseIndex::SlotOf(std::string_view label, std::size_t hash) {
  const std::size_t last = slots_.size() - 1;
  std::size_t i = hash & last;
  while (slots_[i].row >= 0 &&
         !(slots_[i].hash == hash && rows_[static_cast<std::size_t>(slots_[i].row)].label == label))
    i = (i + 1) & last;
  return slots_[i];
}

int PoseIndex::Find(std::string_view label) {
  for (const int row : {last_row_, last_row_ + 1})
    if (row >= 0 && row < static_cast<int>(rows_.size()) &&
        rows_[static_cast<std::size_t>(row)].label == label)
      return last_row_ = row;
  const int row = SlotOf(label, std::hash<std::string_view>()(label)).row;
  if (row >= 0) last_row_ = row;
  return row;
}

}  // namespace hexcal
