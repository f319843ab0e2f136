// SPDX-License-Identifier: BSD-3-Clause
#include "measurement/importers/trajectories.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "config/number.h"
#include "measurement/checked_values.h"
#include "measurement/importers/delimited_reader.h"
#include "measurement/importers/times.h"
#include "measurement/labels.h"

namespace hexcal {
namespace {

constexpr std::size_t kPoseCells = 8;

// A row's pose from its second cell on. scalar_first: qw stands before qx qy qz.
Pose3d PoseOfRow(const DelimitedReader& reader, bool scalar_first) {
  const Eigen::Vector3d translation(reader.Number(1), reader.Number(2), reader.Number(3));
  Eigen::Vector4d wxyz;
  for (std::size_t k = 0; k < 4; ++k)
    wxyz[static_cast<Eigen::Index>(scalar_first ? k : (k + 1) % 4)] = reader.Number(4 + k);
  return {translation, CheckedQuaternion(wxyz, reader.At(4))};
}

void AddRow(const DelimitedReader& reader,
            std::int64_t time,
            const Pose3d& pose,
            Recording& recording) {
  CheckReadings(recording.rows, 1, reader.Where());
  recording.times.push_back(time);
  recording.lines.push_back(reader.LineNumber());
  recording.bodies.front().poses.emplace_back(pose);
  ++recording.rows;
}

Recording Started(const std::string& path, RecordedBody::Scalar scalar, const char* reading) {
  Recording recording;
  recording.path = path;
  recording.bodies.push_back({"trajectory", {}, {}});
  recording.bodies.back().scalar = scalar;
  recording.reading = reading;
  return recording;
}

void RequireRows(const Recording& recording, std::string_view expected) {
  if (recording.rows == 0) throw InputError(FileLocation(recording.path), "no rows", expected);
}

// The first line that is neither empty nor a comment.
std::string_view FirstRow(std::string_view text) {
  while (!text.empty()) {
    const std::size_t end = text.find_first_of("\r\n");
    const std::string_view line = Trimmed(text.substr(0, end));
    if (!line.empty() && line.front() != '#') return line;
    if (end == std::string_view::npos) break;
    text.remove_prefix(end + 1);
  }
  return {};
}

}  // namespace

bool IsTum(std::string_view beginning) {
  constexpr double kTolerance = 1e-3;
  std::string_view row = FirstRow(beginning);
  Eigen::Matrix<double, kPoseCells, 1> numbers;
  std::size_t count = 0;
  for (; !row.empty(); ++count) {
    const std::size_t end = std::min(row.find_first_of(" \t"), row.size());
    const std::optional<double> number = ParseDouble(row.substr(0, end));
    if (!number || count == kPoseCells) return false;
    numbers[static_cast<Eigen::Index>(count)] = *number;
    row = Trimmed(row.substr(end));
  }
  return count == kPoseCells && std::abs(numbers.tail<4>().norm() - 1.0) <= kTolerance;
}

Recording ReadTum(const std::string& path, const ImportOptions&) {
  constexpr const char* kExpected =
      "a TUM trajectory: rows of 8 numbers between blanks, seconds x y z qx qy qz qw";
  DelimitedReader reader(path);
  Recording recording = Started(path, RecordedBody::Scalar::kLast, "m, quaternions scalar last");
  while (reader.Next()) {
    const std::string_view line = Trimmed(reader.Line());
    if (line.empty() || line.front() == '#') continue;
    reader.Split(' ');
    reader.RequireSize(kPoseCells, kExpected);
    AddRow(reader, reader.Seconds(0), PoseOfRow(reader, false), recording);
  }
  RequireRows(recording, kExpected);
  return recording;
}

Recording ReadEuroc(const std::string& path, const ImportOptions&) {
  constexpr const char* kExpected =
      "an EuRoC trajectory: a line '#timestamp, ...', then rows of nanoseconds,x,y,z,qw,qx,qy,qz "
      "and more";
  DelimitedReader reader(path);
  Recording recording = Started(path, RecordedBody::Scalar::kFirst, "m, quaternions scalar first");
  if (!reader.Next()) throw InputError(reader.File(), "an empty file", kExpected);
  if (Trimmed(reader.Line()).substr(0, 1) != "#")
    throw InputError(reader.Where(), Quoted(Trimmed(reader.Line())), kExpected);
  std::size_t columns = 0;
  while (reader.Next()) {
    const std::string_view line = Trimmed(reader.Line());
    if (line.empty() || line.front() == '#') continue;
    reader.Split(',');
    if (columns == 0) columns = std::max(reader.size(), kPoseCells);
    reader.RequireSize(columns, kExpected);
    const std::optional<long> time = ParseInteger(reader.Text(0));
    if (!time || *time < -kMostNanoseconds || *time > kMostNanoseconds)
      throw InputError(reader.At(0), Quoted(reader.Text(0)), "a time in whole nanoseconds");
    AddRow(reader, *time, PoseOfRow(reader, true), recording);
  }
  RequireRows(recording, kExpected);
  return recording;
}

}  // namespace hexcal
