// SPDX-License-Identifier: BSD-3-Clause
#include "measurement/importers/stops.h"

#include <fmt/format.h>

#include "measurement/importers/times.h"

namespace hexcal {
namespace {

constexpr double kStillMetres = 1e-5;
constexpr double kStillRadians = 5e-5;

bool IsStill(const Pose3d& pose, const Pose3d& first) {
  const Vector6d moved = Minus(pose, first);
  return moved.head<3>().norm() <= kStillMetres && moved.tail<3>().norm() <= kStillRadians;
}

void RequireLog(const Recording& robot) {
  if (robot.bodies.size() != 1 || robot.times.size() != robot.rows)
    throw InputError(FileLocation(robot.path),
                     "no times, or not one robot",
                     "the poses of one robot with their times, for --stops");
  const RecordedBody& body = robot.bodies.front();
  for (std::size_t i = 0; i < robot.rows; ++i) {
    const Location where{
        FileLocation(robot.path).file, robot.lines.empty() ? 0 : robot.lines[i], 0};
    if (!body.poses[i]) throw InputError(where, "no pose of the robot", "one in every row");
    if (i > 0 && robot.times[i] <= robot.times[i - 1])
      throw InputError(where, "a time that is not after the one before", "rising times");
  }
}

// Rows first..last of the log as one row of stops.
void AddStop(const Recording& robot, std::size_t first, std::size_t last, Recording& stops) {
  const std::size_t middle = first + (last - first) / 2;
  const RecordedBody& from = robot.bodies.front();
  RecordedBody& to = stops.bodies.front();
  to.poses.push_back(from.poses[middle]);
  if (!from.vectors.empty()) to.vectors.push_back(from.vectors[middle]);
  if (!robot.lines.empty()) stops.lines.push_back(robot.lines[middle]);
  stops.times.push_back(robot.times[middle]);
  stops.spans.push_back({robot.times[first], robot.times[last]});
  ++stops.rows;
}

}  // namespace

Recording FindStops(const Recording& robot, double shortest) {
  RequireLog(robot);
  const std::optional<std::int64_t> least = Nanoseconds(shortest);
  const RecordedBody& body = robot.bodies.front();
  Recording stops;
  stops.path = robot.path;
  stops.warnings = robot.warnings;
  stops.bodies.push_back({body.name, body.aliases, {}});
  stops.bodies.back().rotation_order = body.rotation_order;
  std::size_t first = 0;
  for (std::size_t i = 1; i <= robot.rows; ++i) {
    if (i < robot.rows && IsStill(*body.poses[i], *body.poses[first])) continue;
    if (least && robot.times[i - 1] - robot.times[first] >= *least)
      AddStop(robot, first, i - 1, stops);
    first = i;
  }
  if (stops.rows == 0)
    throw InputError(FileLocation(robot.path),
                     fmt::format("no stop of {} s or longer in {} rows", shortest, robot.rows),
                     "some for --stops: within 10 um and 50 urad");
  stops.reading = fmt::format("{}, {} rows of a log", robot.reading, robot.rows);
  return stops;
}

}  // namespace hexcal
