// SPDX-License-Identifier: BSD-3-Clause
#include "measurement/marker_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>

#include "config/nearest_word.h"
#include "measurement/marker_body_reader.h"
#include "measurement/table_input.h"

namespace hexcal {
namespace {

// What a row is about, and where it stands.
struct RowKey {
  int pose;
  int frame;
  int marker;  // the tool's markers count on after the base's
  int line;

  bool SameReading(const RowKey& other) const {
    return pose == other.pose && frame == other.frame && marker == other.marker;
  }
  bool operator<(const RowKey& other) const {
    return std::tie(pose, frame, marker, line) <
           std::tie(other.pose, other.frame, other.marker, other.line);
  }
};

// The reader of one table: its columns, and from names to indices.
class MarkerRows {
 public:
  MarkerRows(TableReader& table,
             const RobotPoses& robot_poses,
             const Units& units,
             Measurement& measurement)
      : table_(table),
        robot_poses_(robot_poses),
        units_(units),
        measurement_(measurement),
        pose_index_(robot_poses),
        pose_(table.Column("pose")),
        body_(table.Column("body")),
        marker_(table.Column("marker")),
        xyz_{table.Column("x"), table.Column("y"), table.Column("z")},
        frame_(table.Column("frame")) {
    for (int b = 0; b < 2; ++b)
      for (std::size_t i = 0; i < measurement.bodies[b].markers.size(); ++i)
        marker_index_[b].emplace(measurement.bodies[b].markers[i], static_cast<int>(i));
  }

  void ReadAll() {
    while (table_.Next()) ReadRow();
    RefuseRepeatedRows();
  }

 private:
  void ReadRow() {
    const int pose = FindPose();
    const int body = FindBody();
    const int marker = FindMarker(body);
    const int frame = FindFrame();
    const int first_of_body =
        body == 0 ? 0 : static_cast<int>(measurement_.bodies[0].markers.size());
    keys_.push_back({pose, frame, first_of_body + marker, table_.RowLocation().line});
    if (!IsSeen()) return;
    // Braces keep the order of calls, so that the first bad cell is the one that is named.
    const Eigen::Vector3d p{ReadLength(table_, xyz_[0], units_),
                            ReadLength(table_, xyz_[1], units_),
                            ReadLength(table_, xyz_[2], units_)};
    measurement_.readings.push_back(
        {pose, PublicFrame(frame), static_cast<BodyId>(body), marker, p});
  }

  int FindPose() {
    const int pose = pose_index_.Find(table_.Text(pose_));
    if (pose >= 0) return pose;
    throw InputError(table_.CellLocation(pose_),
                     fmt::format("a measurement of pose {}", Quoted(table_.Text(pose_))),
                     kKnownPose);
  }

  int FindBody() const {
    const std::string_view name = table_.Text(body_);
    for (int body = 0; body < 2; ++body)
      if (name == kBodyNames[body]) return body;
    throw InputError(
        table_.CellLocation(body_), fmt::format("the body {}", Quoted(name)), "base or tool");
  }

  int FindMarker(int body) {
    key_.assign(table_.Text(marker_));  // a member, so that no row of a long table allocates
    const auto found = marker_index_[body].find(key_);
    if (found == marker_index_[body].end()) RefuseMarker(body);
    return found->second;
  }

  [[noreturn]] void RefuseMarker(int body) const {
    const std::vector<std::string>& names = measurement_.bodies[body].markers;
    std::string hint = DidYouMean(key_, {names.begin(), names.end()});
    if (marker_index_[1 - body].count(key_) > 0)
      hint = fmt::format(" (it is one of the {} body)", kBodyNames[1 - body]);
    throw InputError(table_.CellLocation(marker_),
                     fmt::format("the marker {} of the {} body", Quoted(key_), kBodyNames[body]),
                     fmt::format("a marker that bodies: lists for it{}", hint));
  }

  // Frames count in order of first appearance, seen or not.
  int FindFrame() {
    if (frame_ < 0) return 0;
    key_.assign(table_.Text(frame_));
    const auto [found, is_new] = frame_index_.emplace(key_, static_cast<int>(frame_index_.size()));
    if (is_new) {
      CheckLabel(key_, table_.CellLocation(frame_), "frame label");
      public_frame_.push_back(-1);
    }
    return found->second;
  }

  // Frames in which no marker was seen get no label.
  int PublicFrame(int frame) {
    if (frame_ < 0) return 0;
    if (public_frame_[frame] < 0) {
      public_frame_[frame] = static_cast<int>(measurement_.frame_labels.size());
      measurement_.frame_labels.emplace_back(table_.Text(frame_));
    }
    return public_frame_[frame];
  }

  bool IsSeen() const {
    const auto is_empty = [&](int column) { return table_.Empty(column); };
    const auto empty = std::find_if(xyz_.begin(), xyz_.end(), is_empty);
    if (empty == xyz_.end()) return true;
    if (std::all_of(xyz_.begin(), xyz_.end(), is_empty)) return false;
    throw InputError(table_.CellLocation(*empty),
                     fmt::format("an empty {} beside other coordinates", table_.header()[*empty]),
                     "a number; or x, y and z all empty where the marker was not seen");
  }

  // Sorted rather than hashed: 16 bytes a row.
  void RefuseRepeatedRows() {
    std::sort(keys_.begin(), keys_.end());
    int first = -1, second = -1;  // of the pair whose second row stands first in the table
    for (std::size_t i = 1; i < keys_.size(); ++i) {
      if (!keys_[i].SameReading(keys_[i - 1])) continue;
      if (second >= 0 && keys_[second].line <= keys_[i].line) continue;
      first = static_cast<int>(i) - 1, second = static_cast<int>(i);
    }
    if (second < 0) return;
    const RowKey& key = keys_[second];
    const int base_size = static_cast<int>(measurement_.bodies[0].markers.size());
    const int body = key.marker < base_size ? 0 : 1;
    const int marker = key.marker - (body == 0 ? 0 : base_size);
    throw InputError({table_.where().file, key.line, 0},
                     fmt::format("marker {} of the {} body in pose {} a second time{}",
                                 measurement_.bodies[body].markers[marker],
                                 kBodyNames[body],
                                 Quoted(robot_poses_.rows[key.pose].label),
                                 frame_ < 0 ? "" : " in one frame"),
                     fmt::format("one row{} (the first is in line {})",
                                 frame_ < 0 ? ", or a column frame for repeated readings" : "",
                                 keys_[first].line));
  }

  TableReader& table_;
  const RobotPoses& robot_poses_;
  const Units units_;
  Measurement& measurement_;
  PoseIndex pose_index_;
  const int pose_, body_, marker_;
  const std::array<int, 3> xyz_;
  const int frame_;
  std::array<std::unordered_map<std::string, int>, 2> marker_index_;
  std::unordered_map<std::string, int> frame_index_;
  std::vector<int> public_frame_;
  std::vector<RowKey> keys_;
  std::string key_;
};

}  // namespace

void ReadMarkerTable(TableReader& table,
                     const RobotPoses& robot_poses,
                     const Units& units,
                     Measurement& measurement) {
  CheckColumns(table,
               {"pose", "body", "marker", "x", "y", "z"},
               {"frame"},
               "pose, body, marker, x, y, z and optionally frame");
  MarkerRows(table, robot_poses, units, measurement).ReadAll();
}

}  // namespace hexcal
