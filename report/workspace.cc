// SPDX-License-Identifier: BSD-3-Clause
#include "report/workspace.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/rotation_angles.h"
#include "model/hexapod.h"

namespace hexcal {
namespace {

constexpr double kDegree = kPi / 180.0;

constexpr int kLevels = 3;
// The part of a range by which the calibration's poses may miss its ends.
constexpr double kMargin = 0.05;

constexpr const char* kAxes[6] = {"x", "y", "z", "rx", "ry", "rz"};
constexpr const char* kUnits[2] = {" mm", "°"};

// In mm and degrees, as places are stated; 0.0 makes no -0 of a rounding error.
double Shown(double value, int number) {
  return std::round(1e6 * (number < 3 ? 1e3 * value : value / kDegree)) / 1e6 + 0.0;
}

std::array<std::array<double, 2>, 6> BoxOf(const Observations& observations) {
  std::array<std::array<double, 2>, 6> box;
  box.fill({std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()});
  for (const Observation& o : observations.items) {
    const Vector6d y = VectorFromPose(o.base_from_platform);
    for (int i = 0; i < 6; ++i) box[i] = {std::min(box[i][0], y[i]), std::max(box[i][1], y[i])};
  }
  return box;
}

}  // namespace

Vector6d Workspace::Centre() const {
  Vector6d centre;
  for (int i = 0; i < 6; ++i) centre[i] = 0.5 * (box[i][0] + box[i][1]);
  return centre;
}

bool Workspace::IsMeasured(int number) const {
  const auto& [low, high] = box[number];
  const double margin = kMargin * (high - low);
  return measured[number][0] <= low + margin && measured[number][1] >= high - margin;
}

bool Workspace::IsMeasured() const {
  for (int i = 0; i < 6; ++i)
    if (!IsMeasured(i)) return false;
  return true;
}

Workspace MakeWorkspace(const std::optional<std::array<std::array<double, 2>, 6>>& stated,
                        const Observations& observations) {
  Workspace workspace;
  workspace.measured = BoxOf(observations);
  workspace.box = stated.value_or(workspace.measured);
  workspace.is_stated = stated.has_value();
  return workspace;
}

bool IsReached(const Dataset& dataset, const Pose3d& base_from_platform) {
  if (!dataset.hexapod || !dataset.hexapod->leg_limits) return true;
  const LegLengths lengths = InverseKinematics(*dataset.hexapod, base_from_platform);
  const Eigen::Vector2d& limits = *dataset.hexapod->leg_limits;
  return lengths.minCoeff() >= limits[0] && lengths.maxCoeff() <= limits[1];
}

namespace {

// Between a place that the legs reach and another, to a part in a thousand. Of a reach with a gap
// in it, an edge.
Vector6d FarthestReached(const Dataset& dataset, const Vector6d& from, const Vector6d& to) {
  if (IsReached(dataset, PoseFromVector(to))) return to;
  double in = 0.0, out = 1.0;
  for (int i = 0; i < 10; ++i) {
    const double middle = 0.5 * (in + out);
    (IsReached(dataset, PoseFromVector(from + middle * (to - from))) ? in : out) = middle;
  }
  return from + in * (to - from);
}

}  // namespace

std::vector<Place> GridOf(const Workspace& workspace, const Dataset& dataset) {
  const Vector6d centre = workspace.Centre();
  if (!IsReached(dataset, PoseFromVector(centre))) return {};
  int count = 1;
  for (int i = 0; i < 6; ++i) count *= kLevels;
  std::vector<Place> places;
  for (int k = 0; k < count; ++k) {
    Vector6d y;
    for (int i = 0, rest = k; i < 6; ++i, rest /= kLevels) {
      const auto& [low, high] = workspace.box[i];
      y[i] = low + (high - low) * (rest % kLevels) / (kLevels - 1);
    }
    places.push_back({"", PoseFromVector(FarthestReached(dataset, centre, y))});
  }
  return places;
}

std::vector<Place> PosesOf(const Observations& observations) {
  std::vector<Place> places;
  for (const Observation& o : observations.items) places.push_back({o.label, o.base_from_platform});
  return places;
}

std::string BeyondPoses(const Workspace& workspace) {
  std::string words;
  for (int i = 0; i < 6; ++i)
    if (!workspace.IsMeasured(i))
      words += fmt::format("{}{} ({:.4g} to {:.4g}{} measured)",
                           words.empty() ? "" : ", ",
                           kAxes[i],
                           Shown(workspace.measured[i][0], i),
                           Shown(workspace.measured[i][1], i),
                           kUnits[i / 3]);
  return words;
}

std::string WordsOf(const Place& place) {
  const Vector6d y = VectorFromPose(place.base_from_platform);
  std::string words = place.label.empty() ? "" : fmt::format("pose {}: ", place.label);
  for (int i = 0; i < 6; ++i)
    words +=
        fmt::format("{}{} {:.4g}{}", i == 0 ? "" : ", ", kAxes[i], Shown(y[i], i), kUnits[i / 3]);
  return words;
}

}  // namespace hexcal
