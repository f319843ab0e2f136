// SPDX-License-Identifier: BSD-3-Clause
#include "hidden/truth.h"

#include <stdexcept>

namespace hexcal::hidden {

Motion TruePlatform(const Scene& scene, const Row& row, const Additions& additions) {
  const Six lengths = row.lengths + additions.leg;
  const Joints base = scene.hexapod.base + additions.base;
  const Joints platform = scene.hexapod.platform + additions.platform;
  Motion base_from_platform = row.base_from_platform;
  const bool as_reported =
      additions.leg.isZero(0) && additions.base.isZero(0) && additions.platform.isZero(0);
  if (!as_reported && !CloseLoop(base, platform, lengths, &base_from_platform))
    throw std::runtime_error("a hidden effect leaves the legs open");
  return Moved(base_from_platform, additions.platform_twist);
}

namespace {

Motion ToolIn(const Scene& scene, const Motion& base_from_platform, const Additions& additions) {
  return Moved(scene.world_from_base, additions.base_twist) * base_from_platform *
         Moved(scene.platform_from_tool, additions.tool_twist);
}

}  // namespace

Motion TrueTool(const Scene& scene, const Row& row, const Additions& additions) {
  return ToolIn(scene, TruePlatform(scene, row, additions), additions);
}

Reading TrueReading(const Scene& scene,
                    const Row& row,
                    const Additions& additions,
                    const Six& slip) {
  const Motion platform = Moved(TruePlatform(scene, row, additions), slip);
  const Motion stand_from_tracker = Inverse(Moved(Motion(), additions.tracker_twist));
  const Motion tracker_from_world = stand_from_tracker * row.tracker_from_world;
  const Motion tracker_from_tool = tracker_from_world * ToolIn(scene, platform, additions);
  const Markers base = scene.base_markers + additions.base_markers;
  const Markers tool = scene.tool_markers + additions.tool_markers;
  Reading reading;
  for (int m = 0; m < 8; ++m) {
    const Eigen::Vector3d point = m < 4 ? tracker_from_world * Eigen::Vector3d(base.col(m))
                                        : tracker_from_tool * Eigen::Vector3d(tool.col(m - 4));
    Eigen::Vector3d read = point;
    for (const auto& misreading : additions.misreadings) read += misreading(point);
    reading.segment<3>(3 * m) = read;
  }
  return reading;
}

std::vector<Reading> TrueReadings(const Scene& scene, const std::vector<HiddenEffect>& effects) {
  std::vector<Reading> readings;
  for (const Row& row : scene.rows)
    if (row.is_measured) readings.push_back(TrueReading(scene, row, Sum(effects, scene, row)));
  return readings;
}

}  // namespace hexcal::hidden
