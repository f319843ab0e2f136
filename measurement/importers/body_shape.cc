// SPDX-License-Identifier: BSD-3-Clause
#include "measurement/importers/body_shape.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "measurement/checked_values.h"
#include "measurement/importers/shape_misfit.h"
#include "measurement/labels.h"

namespace hexcal {
namespace {

constexpr double kOddDistance = 2e-3;  // m, between a stated shape and what was seen

// "1" is b1 of the base and t1 of the tool.
std::vector<std::string> MarkerNames(const Recording& recording,
                                     const TrackedSide& side,
                                     const char* prefix) {
  std::vector<std::string> names;
  for (const int marker : side.markers) {
    std::string name = CleanLabel(recording.markers[static_cast<std::size_t>(marker)].name);
    if (name.find_first_not_of("0123456789") == std::string::npos) name = prefix + name;
    if (std::find(names.begin(), names.end(), name) != names.end())
      name = fmt::format("{}{}", prefix, names.size() + 1);
    names.push_back(std::move(name));
  }
  return names;
}

using Points = std::vector<std::optional<Eigen::Vector3d>>;

const Points& PointsOf(const Recording& recording, const TrackedSide& side, std::size_t m) {
  return recording.markers[static_cast<std::size_t>(side.markers[m])].points;
}

Eigen::Matrix3Xd MeanInBody(const std::vector<Recording>& tracker,
                            const std::vector<const TrackedSide*>& sides,
                            bool measured_inverse) {
  const std::size_t size = sides.front()->markers.size();
  Eigen::Matrix3Xd mean = Eigen::Matrix3Xd::Zero(3, static_cast<Eigen::Index>(size));
  for (std::size_t m = 0; m < size; ++m) {
    double count = 0.0;
    for (std::size_t file = 0; file < tracker.size(); ++file) {
      const Points& points = PointsOf(tracker[file], *sides[file], m);
      for (std::size_t row = 0; row < tracker[file].rows; ++row) {
        const std::optional<Pose3d>& pose = sides[file]->body->poses[row];
        if (!pose || !points[row]) continue;
        const Pose3d body_from_tracker = measured_inverse ? *pose : pose->Inverse();
        mean.col(static_cast<Eigen::Index>(m)) += body_from_tracker * *points[row];
        count += 1.0;
      }
    }
    if (count == 0.0)
      throw InputError(FileLocation(tracker.front().path),
                       fmt::format("marker {} of {} in no row", m + 1, Quoted(sides.front()->name)),
                       "each marker at least once");
    mean.col(static_cast<Eigen::Index>(m)) /= count;
  }
  return mean;
}

// In the first row that has them, two markers whose distance is not the stated one.
void WarnOfDistances(const Recording& recording,
                     const TrackedSide& side,
                     const StatedShape& stated,
                     std::vector<std::string>& warnings) {
  for (std::size_t a = 0; a < side.markers.size(); ++a) {
    for (std::size_t b = a + 1; b < side.markers.size(); ++b) {
      const Points &of_a = PointsOf(recording, side, a), &of_b = PointsOf(recording, side, b);
      for (std::size_t row = 0; row < recording.rows; ++row) {
        if (!of_a[row] || !of_b[row]) continue;
        const double seen = (*of_a[row] - *of_b[row]).norm();
        const double said = (stated.points.col(static_cast<Eigen::Index>(a)) -
                             stated.points.col(static_cast<Eigen::Index>(b)))
                                .norm();
        if (std::abs(seen - said) > kOddDistance)
          return warnings.push_back(fmt::format(
              "markers {} and {} of {} are {:.2f} mm apart in {}, {:.2f} mm in {}: are the markers "
              "in the same order?",
              a + 1,
              b + 1,
              Quoted(side.name),
              1e3 * seen,
              recording.path,
              1e3 * said,
              stated.path));
        break;
      }
    }
  }
}

}  // namespace

bool HasShape(const TrackedSide& side, const std::optional<StatedShape>& stated) {
  if (side.is_tracker || side.markers.size() < 3) return false;
  return stated || side.body != nullptr || side.markers.size() == 3;
}

BodyShape MakeBodyShape(const std::vector<Recording>& tracker,
                        const std::vector<const TrackedSide*>& sides,
                        const std::optional<StatedShape>& stated,
                        bool measured_inverse,
                        const char* prefix) {
  const TrackedSide& first = *sides.front();
  BodyShape shape;
  shape.body.markers = MarkerNames(tracker.front(), first, prefix);
  if (stated) {
    if (stated->names.size() != first.markers.size())
      throw InputError(FileLocation(stated->path),
                       fmt::format("{} markers", stated->names.size()),
                       fmt::format("{}, as many as {} has in {}",
                                   first.markers.size(),
                                   Quoted(first.name),
                                   tracker.front().path));
    shape.body.p_in_body = stated->points;
    shape.origin = fmt::format("placed as {} says", stated->path);
    WarnOfDistances(tracker.front(), first, *stated, shape.warnings);
  } else if (first.body != nullptr) {
    shape.body.p_in_body = MeanInBody(tracker, sides, measured_inverse);
    shape.origin = "placed by their mean in the frame of its poses";
  } else {
    shape.body.is_centroid = true;
    shape.origin =
        "which make its frame (origin at their centroid, x from the first to the second)";
    return shape;
  }
  if (AreCollinear(shape.body.p_in_body))
    throw InputError(FileLocation(stated ? stated->path : tracker.front().path),
                     fmt::format("the markers of {} on one line", Quoted(first.name)),
                     "three that are not");
  if (!shape.warnings.empty()) return shape;
  const std::string odd = OddShape(
      tracker, sides, shape.body.p_in_body, {stated ? stated->path : "", measured_inverse});
  if (!odd.empty()) shape.warnings.push_back(odd);
  return shape;
}

}  // namespace hexcal
