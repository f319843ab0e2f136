// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "config/input_error.h"
#include "geometry/pose.h"

namespace hexcal {

// A marker as a file of another program has it: one point a row, in the frame of the recording, m;
// none where it was not seen.
struct RecordedMarker {
  std::string name;
  std::vector<std::optional<Eigen::Vector3d>> points;
};

// A tracked body, or the robot: one pose a row, recording_from_body; none where it was not seen.
struct RecordedBody {
  std::string name;
  std::vector<std::string> aliases;          // what else it may be called: port, serial
  std::vector<std::optional<Pose3d>> poses;  // empty: the file has none for this body
  // x y z and three angles, m and rad, where the file states poses so; then in this order:
  // geometry/rotation_order.h.
  std::vector<std::optional<Vector6d>> vectors{};
  std::string rotation_order{};
  std::vector<int> markers{};  // indices into Recording::markers
  // Where the scalar of its quaternions was taken to stand, and nothing in the file says so.
  enum class Scalar { kNamed, kFirst, kLast } scalar = Scalar::kNamed;
};

// What one file of another program holds, in SI. Nothing is said yet of which body is which.
struct Recording {
  std::string path;
  std::size_t rows = 0;
  std::vector<double> frames{};       // the tracker's number of each row; empty: the file has none
  std::vector<std::int64_t> times{};  // ns, one a row; empty: the file has none
  // Begin and end of the rows, ns, where each is a stretch of time (stops.h); else empty.
  std::vector<std::pair<std::int64_t, std::int64_t>> spans{};
  std::vector<std::string> labels{};  // of the rows; empty: the file has none
  std::vector<int> lines{};           // of the rows; empty: the file has no lines
  std::vector<RecordedBody> bodies{};
  std::vector<RecordedMarker> markers{};
  std::vector<std::string> warnings{};  // what is odd but allowed
  std::string reading{};  // how the numbers were understood, in words: units, rotations, directions
};

// A rigid body as the maker of the tracker describes it: its markers in its own frame, m, 3 x n.
struct StatedShape {
  std::string path;
  std::vector<std::string> names;
  Eigen::Matrix3Xd points;
};

// A calibration that another program made: parent_from_child.
struct StoredTransform {
  std::string path;
  bool is_tool = false;  // tool on platform; else tracker in base
  Pose3d parent_from_child;
  std::string parent, child;  // names of the frames
};

// What the files do not say.
struct ImportOptions {
  std::string rotation_order = "xyz";     // of three angles: geometry/rotation_order.h
  std::vector<std::string> columns{};     // of x y z and three angles, by name or number from 1
  std::optional<double> missing_value{};  // a point all of whose coordinates are this is unseen
  std::string map{};                      // a column map's file
};

// What a file of another program may be: bytes of text, and points and poses altogether.
inline constexpr std::int64_t kMostImportBytes = std::int64_t{256} << 20;
inline constexpr std::size_t kMostImportReadings = 20'000'000;

// InputError where rows of so many points and poses are too many.
void CheckReadings(std::size_t rows, std::size_t readings_a_row, const Location& where);

// InputError, with the row's line, where a coordinate of what is called so is beyond 1000 km.
void CheckPlace(const Recording& recording,
                std::size_t row,
                std::string_view name,
                const Eigen::Vector3d& place);

// A warning for points that are exactly zero, which no tracker sees.
void WarnOfZeros(Recording& recording);

}  // namespace hexcal
