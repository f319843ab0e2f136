// SPDX-License-Identifier: BSD-3-Clause
#include "measurement/importers/motive.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "measurement/checked_values.h"
#include "measurement/importers/delimited_reader.h"
#include "measurement/importers/missing.h"
#include "measurement/labels.h"

namespace hexcal {
namespace {

constexpr int kMostHeaderLines = 16;
constexpr std::size_t kFirstColumn = 2;  // behind Frame and Time
constexpr const char* kHeader =
    "an OptiTrack Motive CSV: 'Format Version,...,Length Units,Millimeters,...', then lines of "
    "types, names and axes down to 'Frame,Time (Seconds),X,Y,Z,...'";

using Cells = std::vector<std::string>;

std::string CellOf(const Cells& cells, std::size_t i) { return i < cells.size() ? cells[i] : ""; }

// A run of columns that belong together: of one thing, its rotation or its position.
struct Group {
  std::string type, name, kind;  // "rigid body", "A", "rotation"
  std::string axes;              // "xyzw"
  std::size_t column = 0;
};

class Motive {
 public:
  Motive(const std::string& path, const ImportOptions& options)
      : reader_(path), missing_value_(options.missing_value) {
    recording_.path = path;
  }

  Recording Read() {
    ReadSettings();
    ReadHeader();
    for (const Group& group : Groups()) Place(group);
    LinkMarkers();
    while (reader_.Next()) {
      if (!Trimmed(reader_.Line()).empty()) ReadRow();
    }
    if (recording_.rows == 0)
      throw InputError(reader_.File(), "no row below the header", "a row for each frame");
    if (expected_markers_ > 0)
      recording_.warnings.push_back(fmt::format(
          "{}: {} rigid body markers are not used: their columns hold where they are expected",
          recording_.path,
          expected_markers_));
    WarnOfZeros(recording_);
    recording_.reading = fmt::format("{}, quaternions scalar last", unit_);
    return std::move(recording_);
  }

 private:
  void ReadSettings() {
    if (!reader_.Next()) throw InputError(reader_.File(), "an empty file", kHeader);
    reader_.Split(',');
    if (LowerCase(reader_.Text(0)) != "format version")
      throw InputError(reader_.At(0), Quoted(reader_.Text(0)), kHeader);
    for (std::size_t i = 0; i + 1 < reader_.size(); i += 2) {
      const std::string key = LowerCase(reader_.Text(i)), value = LowerCase(reader_.Text(i + 1));
      const auto refuse = [&](const char* expected) {
        throw InputError(reader_.At(i + 1), fmt::format("{} {}", key, Quoted(value)), expected);
      };
      if (key == "length units") {
        static const std::map<std::string, double> kScales = {
            {"meters", 1.0}, {"centimeters", 1e-2}, {"millimeters", 1e-3}};
        const auto found = kScales.find(value);
        if (found == kScales.end()) refuse("Meters, Centimeters or Millimeters");
        scale_ = found->second;
        unit_ = value;
      } else if (key == "rotation type") {
        if (value != "quaternion") refuse("Quaternion: export rotations so");
      } else if (key == "coordinate space") {
        if (value != "global") refuse("Global: export coordinates so");
      }
    }
    if (unit_.empty()) throw InputError(reader_.Where(), "no 'Length Units'", kHeader);
  }

  Cells Line() {
    reader_.Split(',');
    Cells cells;
    for (std::size_t i = 0; i < reader_.size(); ++i) cells.emplace_back(reader_.Text(i));
    return cells;
  }

  void ReadHeader() {
    for (int lines = 0; lines < kMostHeaderLines && reader_.Next(); ++lines) {
      if (Trimmed(reader_.Line()).empty()) continue;
      Cells cells = Line();
      if (LowerCase(cells[0]) == "frame") {
        axes_ = std::move(cells);
        break;
      }
      const std::string key = LowerCase(CellOf(cells, 1));
      if (key == "type")
        types_ = std::move(cells);
      else if (key == "name")
        names_ = std::move(cells);
      else if (key.empty())
        kinds_ = std::move(cells);
    }
    const char* lacking = axes_.empty()    ? "a line 'Frame,Time...'"
                          : types_.empty() ? "a line ',Type,...'"
                          : names_.empty() ? "a line ',Name,...'"
                          : kinds_.empty() ? "a line of kinds (Rotation, Position)"
                                           : nullptr;
    if (lacking != nullptr)
      throw InputError(reader_.Where(), fmt::format("no {}", lacking), kHeader);
    if (LowerCase(CellOf(axes_, 1)).substr(0, 4) != "time")
      throw InputError(reader_.At(1), Quoted(CellOf(axes_, 1)), "'Time (Seconds)'");
  }

  std::vector<Group> Groups() const {
    std::vector<Group> groups;
    for (std::size_t i = kFirstColumn; i < axes_.size(); ++i) {
      const std::string type = LowerCase(CellOf(types_, i)), kind = LowerCase(CellOf(kinds_, i));
      const std::string name = CellOf(names_, i);
      const bool goes_on = !groups.empty() && groups.back().type == type &&
                           groups.back().name == name && groups.back().kind == kind;
      if (!goes_on) groups.push_back({type, name, kind, "", i});
      groups.back().axes += LowerCase(axes_[i]);
    }
    return groups;
  }

  void Place(const Group& group) {
    const bool is_position = group.kind == "position", is_rotation = group.kind == "rotation";
    const bool is_body = group.type == "rigid body";
    if (group.type == "rigid body marker" || group.type == "marker constraint") {
      expected_markers_ += is_position ? 1 : 0;
      return;
    }
    if (!(is_body && (is_position || is_rotation)) && !(group.type == "marker" && is_position))
      return;
    const std::string expected = is_rotation ? "xyzw" : "xyz";
    if (group.axes != expected)
      throw InputError(
          reader_.At(group.column),
          fmt::format(
              "the axes {} of the {} of {}", Quoted(group.axes), group.kind, Quoted(group.name)),
          expected);
    if (!is_body) {
      recording_.markers.push_back({group.name, {}});
      marker_columns_.push_back(group.column);
      return;
    }
    const std::size_t body = BodyOf(group);
    std::size_t& column = (is_rotation ? rotation_columns_ : position_columns_)[body];
    if (column != 0)
      throw InputError(reader_.At(group.column),
                       fmt::format("the {} of {} a second time", group.kind, Quoted(group.name)),
                       "each once");
    column = group.column;
  }

  std::size_t BodyOf(const Group& group) {
    for (std::size_t b = 0; b < recording_.bodies.size(); ++b)
      if (recording_.bodies[b].name == group.name) return b;
    recording_.bodies.push_back({group.name, {}, {}});
    rotation_columns_.push_back(0);
    position_columns_.push_back(0);
    return recording_.bodies.size() - 1;
  }

  void LinkMarkers() {
    for (std::size_t b = 0; b < recording_.bodies.size(); ++b) {
      RecordedBody& body = recording_.bodies[b];
      if (rotation_columns_[b] == 0 || position_columns_[b] == 0)
        throw InputError(reader_.Where(),
                         fmt::format("{} without rotation or without position", Quoted(body.name)),
                         "both of each rigid body");
      for (std::size_t m = 0; m < recording_.markers.size(); ++m)
        if (recording_.markers[m].name.rfind(body.name + ":", 0) == 0)
          body.markers.push_back(static_cast<int>(m));
    }
    if (recording_.bodies.empty() && recording_.markers.empty())
      throw InputError(reader_.Where(), "neither markers nor rigid bodies", "some of them");
  }

  void ReadRow() {
    reader_.Split(',');
    reader_.DropEmptyEnd(axes_.size());
    reader_.RequireSize(axes_.size(), "one for each column");
    CheckReadings(
        recording_.rows, recording_.bodies.size() + recording_.markers.size(), reader_.Where());
    recording_.times.push_back(reader_.Seconds(1));
    recording_.frames.push_back(reader_.Number(0));
    recording_.lines.push_back(reader_.LineNumber());
    for (std::size_t m = 0; m < marker_columns_.size(); ++m)
      recording_.markers[m].points.push_back(
          reader_.Point(marker_columns_[m], scale_, missing_value_));
    for (std::size_t b = 0; b < recording_.bodies.size(); ++b)
      recording_.bodies[b].poses.push_back(BodyPose(b));
    ++recording_.rows;
  }

  std::optional<Pose3d> BodyPose(std::size_t b) const {
    const std::size_t r = rotation_columns_[b];
    const std::optional<Eigen::Vector3d> position =
        reader_.Point(position_columns_[b], scale_, missing_value_);
    if (!position || IsMissing(reader_.Text(r))) return std::nullopt;
    const Eigen::Vector4d wxyz(
        reader_.Number(r + 3), reader_.Number(r), reader_.Number(r + 1), reader_.Number(r + 2));
    return Pose3d{*position, CheckedQuaternion(wxyz, reader_.At(r))};
  }

  DelimitedReader reader_;
  std::optional<double> missing_value_;
  Recording recording_;
  double scale_ = 1.0;  // m per unit
  std::string unit_;
  Cells types_, names_, kinds_, axes_;  // lines of the header
  std::vector<std::size_t> marker_columns_, rotation_columns_, position_columns_;
  std::size_t expected_markers_ = 0;
};

}  // namespace

Recording ReadMotive(const std::string& path, const ImportOptions& options) {
  return Motive(path, options).Read();
}

}  // namespace hexcal
