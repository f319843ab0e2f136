// SPDX-License-Identifier: BSD-3-Clause
#include "measurement/importers/columns.h"

#include <fmt/format.h>

#include <array>

#include "config/number.h"
#include "geometry/rotation_order.h"
#include "measurement/checked_values.h"
#include "measurement/importers/column_map.h"
#include "measurement/importers/delimited_reader.h"
#include "measurement/importers/missing.h"
#include "measurement/importers/times.h"
#include "measurement/labels.h"

namespace hexcal {
namespace {

class Columns {
 public:
  Columns(const std::string& path, const ImportOptions& options)
      : reader_(path), map_(ReadColumnMap(options.map)), missing_(map_.missing) {
    if (options.missing_value) missing_ = options.missing_value;
    reader_.set_decimal_comma(map_.decimal_comma);
    recording_.path = path;
  }

  Recording Read() {
    for (long i = 0; i < map_.skip; ++i)
      if (!reader_.Next())
        throw InputError(reader_.File(),
                         fmt::format("{} lines", i),
                         fmt::format("{} to skip and a row, as the column map says", map_.skip));
    if (map_.has_header) ReadHeader();
    while (NextRow()) {
      if (places_.empty()) FindColumns();
      ReadRow();
    }
    if (recording_.rows == 0) throw InputError(reader_.File(), "no rows", "rows of a table");
    WarnOfZeros(recording_);
    recording_.reading = "by a column map";
    return std::move(recording_);
  }

 private:
  bool NextRow() {
    while (reader_.Next()) {
      const std::string_view line = Trimmed(reader_.Line());
      const bool is_comment =
          !map_.comment.empty() && line.substr(0, map_.comment.size()) == map_.comment;
      if (line.empty() || is_comment) continue;
      reader_.Split(map_.delimiter);
      return true;
    }
    return false;
  }

  void ReadHeader() {
    if (!NextRow()) throw InputError(reader_.File(), "no header", "a line of column names");
    for (std::size_t i = 0; i < reader_.size(); ++i) header_.emplace_back(reader_.Text(i));
  }

  std::size_t Place(const ColumnName& column) const {
    std::size_t found = 0, count = 0;
    for (std::size_t i = 0; i < header_.size(); ++i) {
      if (header_[i] != column.name) continue;
      found = i;
      ++count;
    }
    if (count == 1) return found;
    const std::optional<long> number = ParseInteger(column.name);
    const std::size_t size = map_.has_header ? header_.size() : reader_.size();
    if (count == 0 && number && *number >= 1 && *number <= static_cast<long>(size))
      return static_cast<std::size_t>(*number) - 1;
    throw InputError(
        column.where,
        fmt::format(
            "the column {}, {} of that name in {}", Quoted(column.name), count, recording_.path),
        fmt::format("one of its {} columns, by a name that it has once or by a number "
                    "from 1",
                    size));
  }

  void FindColumns() {
    width_ = map_.has_header ? header_.size() : reader_.size();
    const auto add = [this](const std::vector<ColumnName>& columns) {
      for (const ColumnName& column : columns) places_.push_back(Place(column));
    };
    for (const MappedMarker& marker : map_.markers) {
      add(marker.position);
      recording_.markers.push_back({marker.name, {}});
    }
    for (const MappedBody& body : map_.bodies) {
      add(body.position);
      add(body.rotation);
      recording_.bodies.push_back({body.name, {}, {}});
      if (body.kind == MappedBody::Rotation::kAngles)
        recording_.bodies.back().rotation_order = body.order;
      if (body.kind == MappedBody::Rotation::kQuaternion)
        recording_.bodies.back().scalar = RecordedBody::Scalar::kFirst;
      for (const std::string& name : body.markers)
        for (std::size_t m = 0; m < map_.markers.size(); ++m)
          if (map_.markers[m].name == name)
            recording_.bodies.back().markers.push_back(static_cast<int>(m));
    }
    if (map_.time) time_ = Place(*map_.time);
    if (map_.label) label_ = Place(*map_.label);
  }

  void ReadRow() {
    reader_.DropEmptyEnd(width_);
    reader_.RequireSize(width_, "one for each column");
    CheckReadings(recording_.rows, map_.markers.size() + map_.bodies.size(), reader_.Where());
    const std::size_t* next = places_.data();
    for (RecordedMarker& marker : recording_.markers) {
      marker.points.push_back(Point(next));
      next += 3;
    }
    for (std::size_t b = 0; b < map_.bodies.size(); ++b) {
      ReadBody(map_.bodies[b], next, recording_.bodies[b]);
      next += 3 + map_.bodies[b].rotation.size();
    }
    if (map_.time) recording_.times.push_back(Time());
    if (map_.label) recording_.labels.emplace_back(reader_.Text(label_));
    recording_.lines.push_back(reader_.LineNumber());
    ++recording_.rows;
  }

  std::int64_t Time() const {
    if (map_.time_unit == 1.0 && !map_.decimal_comma) return reader_.Seconds(time_);
    const std::optional<long> whole = ParseInteger(reader_.Text(time_));
    if (map_.time_unit == 1e-9 && whole && *whole >= -kMostNanoseconds &&
        *whole <= kMostNanoseconds)
      return *whole;  // to the last digit
    const std::optional<std::int64_t> time = Nanoseconds(map_.time_unit * reader_.Number(time_));
    if (!time) throw InputError(reader_.At(time_), Quoted(reader_.Text(time_)), "a time");
    return *time;
  }

  // In the columns next[0..2].
  std::optional<Eigen::Vector3d> Point(const std::size_t* next) const {
    return reader_.Point({next[0], next[1], next[2]}, map_.units.length, missing_);
  }

  void ReadBody(const MappedBody& mapped, const std::size_t* next, RecordedBody& body) const {
    const std::optional<Eigen::Vector3d> position = Point(next);
    const bool is_angles = mapped.kind == MappedBody::Rotation::kAngles;
    body.poses.emplace_back();
    if (is_angles) body.vectors.emplace_back();
    next += 3;
    if (!position || IsMissing(reader_.Text(next[0]))) return;
    if (is_angles) {
      const Eigen::Vector3d angles = map_.units.angle * Eigen::Vector3d(reader_.Number(next[0]),
                                                                        reader_.Number(next[1]),
                                                                        reader_.Number(next[2]));
      Vector6d vector;
      vector << *position, angles;
      body.vectors.back() = vector;
      body.poses.back() = MakePose(RotationByOrder(mapped.order, angles), *position);
    } else if (mapped.kind == MappedBody::Rotation::kQuaternion) {
      Eigen::Vector4d wxyz;
      for (std::size_t k = 0; k < 4; ++k)
        wxyz[static_cast<Eigen::Index>(k)] = reader_.Number(next[k]);
      body.poses.back() = Pose3d{*position, CheckedQuaternion(wxyz, reader_.At(next[0]))};
    } else {
      Eigen::Matrix3d matrix;
      for (std::size_t k = 0; k < 9; ++k)
        matrix(static_cast<Eigen::Index>(k / 3), static_cast<Eigen::Index>(k % 3)) =
            reader_.Number(next[k]);
      body.poses.back() = MakePose(CheckedRotation(matrix, reader_.At(next[0])), *position);
    }
  }

  DelimitedReader reader_;
  ColumnMap map_;
  std::optional<double> missing_;
  Recording recording_;
  std::vector<std::string> header_;
  std::vector<std::size_t> places_;  // of the markers' columns, then the bodies'
  std::size_t width_ = 0, time_ = 0, label_ = 0;
};

}  // namespace

Recording ReadColumnsFile(const std::string& path, const ImportOptions& options) {
  if (options.map.empty())
    throw InputError(FileLocation(path),
                     "a table without a column map",
                     "--map=FILE.yaml for the tracker's, --robot_map=FILE.yaml for the robot's");
  return Columns(path, options).Read();
}

}  // namespace hexcal
