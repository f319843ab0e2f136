// SPDX-License-Identifier: BSD-3-Clause
#include "measurement/labels.h"

#include <fmt/format.h>

#include <algorithm>

#include "config/utf8.h"

namespace hexcal {
namespace {

bool IsControl(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }

bool CsvCanCarry(std::string_view text) {
  if (text.front() == '#' || text.front() == ' ' || text.back() == ' ') return false;
  return std::none_of(
      text.begin(), text.end(), [](char c) { return c == ',' || c == '"' || IsControl(c); });
}

}  // namespace

std::string Quoted(std::string_view text) { return fmt::format("'{}'", Shorten(text)); }

void CheckLabel(std::string_view text, const Location& where, std::string_view what) {
  if (text.empty()) throw InputError(where, fmt::format("an empty {}", what), "some text");
  if (CsvCanCarry(text)) return;
  throw InputError(where,
                   fmt::format("the {} {}", what, Quoted(text)),
                   "text without commas, double quotes, line breaks, a leading '#' or blanks at "
                   "its ends, which a table cannot carry");
}

PoseIndex::PoseIndex(const RobotPoses& robot_poses) {
  row_of_label_.reserve(robot_poses.rows.size());
  for (std::size_t row = 0; row < robot_poses.rows.size(); ++row) {
    const RobotPose& pose = robot_poses.rows[row];
    const auto [first, is_new] = row_of_label_.emplace(pose.label, static_cast<int>(row));
    if (is_new) continue;
    throw InputError({robot_poses.where.file, pose.line, 0},
                     fmt::format("the pose label {} a second time", Quoted(pose.label)),
                     fmt::format("every label once (the first is in line {})",
                                 robot_poses.rows[first->second].line));
  }
}

int PoseIndex::Find(std::string_view label) {
  if (last_row_ >= 0 && label == last_label_) return last_row_;
  const auto found = row_of_label_.find(label);
  if (found == row_of_label_.end()) return -1;
  last_label_ = found->first;
  return last_row_ = found->second;
}

}  // namespace hexcal
