// SPDX-License-Identifier: BSD-3-Clause
#include "measurement/importers/pi_gcs.h"

#include <fmt/format.h>

#include <array>

#include "config/number.h"
#include "config/units.h"
#include "geometry/rotation_order.h"
#include "measurement/importers/delimited_reader.h"
#include "measurement/importers/times.h"
#include "measurement/labels.h"

namespace hexcal {
namespace {

constexpr double kMillimetre = 1e-3;
constexpr double kDegree = kPi / 180;
constexpr std::size_t kMostColumns = 64;
constexpr std::array<std::string_view, 6> kAxes = {"x", "y", "z", "u", "v", "w"};
constexpr const char* kHeader =
    "the header of a PI GCS array: lines '# TYPE = 1', '# SEPARATOR = 9', '# DIM = 6', "
    "'# NAME0 = ...' and '# END_HEADER'";

struct Header {
  char separator = '\t';
  std::size_t columns = 0;
  long rows = -1;  // as stated
  double sample_time = 0.0;
  std::vector<std::string> names;
};

class PiGcs {
 public:
  PiGcs(const std::string& path, const ImportOptions& options) : reader_(path), options_(options) {
    recording_.path = path;
    recording_.bodies.push_back({"robot", {}, {}});
    recording_.bodies.back().rotation_order = options.rotation_order;
  }

  Recording Read() {
    ReadHeader();
    FindAxes();
    while (reader_.Next()) {
      if (!Trimmed(reader_.Line()).empty()) ReadRow();
    }
    if (recording_.rows == 0)
      throw InputError(reader_.File(), "no row below the header", "a row for each pose");
    if (header_.rows >= 0 && static_cast<std::size_t>(header_.rows) != recording_.rows)
      recording_.warnings.push_back(fmt::format("{}: {} rows, where NDATA says {}; all are used",
                                                recording_.path,
                                                recording_.rows,
                                                header_.rows));
    recording_.reading = fmt::format("mm, degrees, rotation {}", Order());
    return std::move(recording_);
  }

 private:
  const std::string& Order() const { return options_.rotation_order; }

  void ReadHeader() {
    if (!reader_.Next()) throw InputError(reader_.File(), "an empty file", kHeader);
    while (true) {
      std::string_view line = Trimmed(reader_.Line());
      if (line.empty() || line.front() != '#') {
        throw InputError(reader_.Where(), Quoted(line), kHeader);
      }
      line = Trimmed(line.substr(1));
      if (line == "END_HEADER") break;
      const std::size_t equals = line.find('=');
      if (equals != std::string_view::npos)
        ReadEntry(Trimmed(line.substr(0, equals)), Trimmed(line.substr(equals + 1)));
      if (!reader_.Next())
        throw InputError(reader_.File(), "the end of the file", "a line '# END_HEADER'");
    }
    if (header_.columns == 0) throw InputError(reader_.Where(), "no line '# DIM = ...'", kHeader);
    if (header_.names.size() > header_.columns)
      throw InputError(reader_.File(),
                       fmt::format("NAME{}", header_.names.size() - 1),
                       fmt::format("names of {} columns, as DIM says", header_.columns));
    header_.names.resize(header_.columns);
  }

  long Integer(std::string_view key, std::string_view value, long low, long high) const {
    const std::optional<long> number = ParseInteger(value);
    if (number && *number >= low && *number <= high) return *number;
    throw InputError(reader_.Where(),
                     fmt::format("{} = {}", key, Quoted(value)),
                     fmt::format("a whole number from {} to {}", low, high));
  }

  void ReadEntry(std::string_view key, std::string_view value) {
    if (key == "SEPARATOR") {
      const long code = Integer(key, value, 9, 124);
      if (std::string_view("\t ,;|").find(static_cast<char>(code)) == std::string_view::npos)
        throw InputError(reader_.Where(),
                         fmt::format("SEPARATOR = {}", code),
                         "9 (tab), 32 (space), 44 (comma), 59 (semicolon) or 124 (bar)");
      header_.separator = static_cast<char>(code);
    } else if (key == "DIM") {
      header_.columns = static_cast<std::size_t>(Integer(key, value, 1, kMostColumns));
    } else if (key == "NDATA") {
      header_.rows = Integer(key, value, 0, 1'000'000'000);
    } else if (key == "SAMPLE_TIME") {
      const std::optional<double> seconds = ParseDouble(value);
      if (!seconds || !(*seconds > 0.0) || !(*seconds < 1e6))
        throw InputError(
            reader_.Where(), fmt::format("SAMPLE_TIME = {}", Quoted(value)), "seconds above 0");
      header_.sample_time = *seconds;
    } else if (key.substr(0, 4) == "NAME") {
      const auto i = static_cast<std::size_t>(Integer("NAME", key.substr(4), 0, kMostColumns - 1));
      if (i >= header_.names.size()) header_.names.resize(i + 1);
      header_.names[i] = value;
    }
  }

  // The last word of a name, without signs: "Actual Position of Axis X" is axis x.
  static std::string LastWord(std::string_view name) {
    const std::size_t end = name.find_last_not_of(" \t.:)]'\"") + 1;
    const std::string_view before = name.substr(0, end);
    const std::size_t begin = before.find_last_of(" \t_:(['\"") + 1;
    return LowerCase(before.substr(begin));
  }

  void FindAxes() {
    for (std::size_t axis = 0; axis < kAxes.size(); ++axis)
      columns_[axis] =
          options_.columns.empty() ? FindByAxis(kAxes[axis]) : FindByName(options_.columns[axis]);
  }

  std::string Names() const {
    std::string names;
    for (const std::string& name : header_.names)
      names += fmt::format("{}{}", names.empty() ? "" : ", ", Quoted(name));
    return names;
  }

  std::size_t FindByAxis(std::string_view axis) const {
    std::size_t found = header_.names.size(), count = 0;
    for (std::size_t i = 0; i < header_.names.size(); ++i) {
      if (LastWord(header_.names[i]) != axis) continue;
      found = i;
      ++count;
    }
    if (count == 1) return found;
    throw InputError(reader_.File(),
                     fmt::format("{} columns for the axis {} among {}", count, axis, Names()),
                     "one for each of X Y Z U V W; --robot_columns=A,B,C,D,E,F says which they "
                     "are, by name or by number from 1");
  }

  std::size_t FindByName(const std::string& wanted) const {
    for (std::size_t i = 0; i < header_.names.size(); ++i)
      if (header_.names[i] == wanted) return i;
    const std::optional<long> number = ParseInteger(wanted);
    if (number && *number >= 1 && *number <= static_cast<long>(header_.columns))
      return static_cast<std::size_t>(*number) - 1;
    throw InputError(reader_.File(),
                     fmt::format("the columns {}", Names()),
                     fmt::format("one named {}, or a number of a column from 1", Quoted(wanted)));
  }

  void ReadRow() {
    reader_.Split(header_.separator);
    reader_.DropEmptyEnd(header_.columns);
    reader_.RequireSize(header_.columns, "as DIM says");
    CheckReadings(recording_.rows, 1, reader_.Where());
    Vector6d vector;
    for (Eigen::Index i = 0; i < 6; ++i)
      vector[i] = (i < 3 ? kMillimetre : kDegree) * reader_.Number(columns_[i]);
    RecordedBody& robot = recording_.bodies.front();
    robot.vectors.emplace_back(vector);
    robot.poses.emplace_back(
        MakePose(RotationByOrder(Order(), vector.tail<3>()), vector.head<3>()));
    if (header_.sample_time > 0.0) {
      const std::optional<std::int64_t> time =
          Nanoseconds(header_.sample_time * static_cast<double>(recording_.rows));
      if (!time) throw InputError(reader_.Where(), "a time beyond 95 years", "another SAMPLE_TIME");
      recording_.times.push_back(*time);
    }
    recording_.lines.push_back(reader_.LineNumber());
    ++recording_.rows;
  }

  DelimitedReader reader_;
  const ImportOptions& options_;
  Header header_;
  Recording recording_;
  std::array<std::size_t, 6> columns_ = {};
};

}  // namespace

Recording ReadPiGcs(const std::string& path, const ImportOptions& options) {
  return PiGcs(path, options).Read();
}

}  // namespace hexcal
