// SPDX-License-Identifier: BSD-3-Clause
#include "measurement/importers/shape_misfit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "geometry/align_points.h"
#include "measurement/checked_values.h"
#include "measurement/labels.h"

namespace hexcal {
namespace {

constexpr double kOddMisfit = 2e-3;  // m
constexpr double kClearGain = 10.0;  // in variance
constexpr double kRounding = 1e-9;   // m, below which nothing is told apart
constexpr std::size_t kMostRows = 20;
constexpr Eigen::Index kMostToReorder = 5;  // markers: 120 orders

using Order = std::vector<Eigen::Index>;

// The readings of rows in which every marker was seen, 3 x n each.
std::vector<Eigen::Matrix3Xd> WholeRows(const std::vector<Recording>& tracker,
                                        const std::vector<const TrackedSide*>& sides) {
  std::vector<Eigen::Matrix3Xd> rows;
  for (std::size_t file = 0; file < tracker.size(); ++file) {
    const std::vector<int>& markers = sides[file]->markers;
    for (std::size_t row = 0; row < tracker[file].rows; ++row) {
      Eigen::Matrix3Xd points(3, static_cast<Eigen::Index>(markers.size()));
      bool is_whole = true;
      for (std::size_t m = 0; m < markers.size() && is_whole; ++m) {
        const auto& point = tracker[file].markers[static_cast<std::size_t>(markers[m])].points[row];
        is_whole = point.has_value();
        if (is_whole) points.col(static_cast<Eigen::Index>(m)) = *point;
      }
      if (is_whole && !AreCollinear(points)) rows.push_back(std::move(points));
    }
  }
  if (rows.size() <= kMostRows) return rows;
  std::vector<Eigen::Matrix3Xd> some;
  for (std::size_t i = 0; i < kMostRows; ++i) some.push_back(rows[i * rows.size() / kMostRows]);
  return some;
}

// RMS distance of a reading from where the shape has it.
double Misfit(const std::vector<Eigen::Matrix3Xd>& rows, const Eigen::Matrix3Xd& shape) {
  double sum = 0.0;
  for (const Eigen::Matrix3Xd& seen : rows) {
    const Pose3d seen_from_shape = AlignPoints(seen, shape);
    for (Eigen::Index m = 0; m < shape.cols(); ++m)
      sum += (seen.col(m) - seen_from_shape * Eigen::Vector3d(shape.col(m))).squaredNorm();
  }
  return std::sqrt(sum / static_cast<double>(rows.size()) / static_cast<double>(shape.cols()));
}

// The same with the file's own poses; 0 where there is nothing to compare.
double MisfitOfPoses(const std::vector<Recording>& tracker,
                     const std::vector<const TrackedSide*>& sides,
                     const Eigen::Matrix3Xd& shape,
                     bool measured_inverse) {
  double sum = 0.0, count = 0.0;
  for (std::size_t file = 0; file < tracker.size(); ++file) {
    for (std::size_t row = 0; row < tracker[file].rows; ++row) {
      const std::optional<Pose3d>& pose = sides[file]->body->poses[row];
      if (!pose) continue;
      const Pose3d seen_from_body = measured_inverse ? pose->Inverse() : *pose;
      for (Eigen::Index m = 0; m < shape.cols(); ++m) {
        const int marker = sides[file]->markers[static_cast<std::size_t>(m)];
        const auto& seen = tracker[file].markers[static_cast<std::size_t>(marker)].points[row];
        if (!seen) continue;
        sum += (*seen - seen_from_body * Eigen::Vector3d(shape.col(m))).squaredNorm();
        count += 1.0;
      }
    }
  }
  return count > 0.0 ? std::sqrt(sum / count) : 0.0;
}

// Column m of the shape in this order is marker m's.
struct Candidate {
  Order order;
  bool is_mirrored = false;
  double misfit = 0.0;
};

Candidate BestOf(const std::vector<Eigen::Matrix3Xd>& rows, const Eigen::Matrix3Xd& shape) {
  Order order(static_cast<std::size_t>(shape.cols()));
  std::iota(order.begin(), order.end(), 0);
  Candidate best{order, false, Misfit(rows, shape)};
  do {
    for (const bool is_mirrored : {false, true}) {
      Eigen::Matrix3Xd other(3, shape.cols());
      for (Eigen::Index m = 0; m < shape.cols(); ++m)
        other.col(m) = shape.col(order[static_cast<std::size_t>(m)]);
      if (is_mirrored) other.row(2) *= -1.0;
      const double misfit = Misfit(rows, other);
      // Of those that fit alike the first, which changes least.
      if (misfit * std::sqrt(2.0) < best.misfit) best = {order, is_mirrored, misfit};
    }
  } while (shape.cols() <= kMostToReorder && std::next_permutation(order.begin(), order.end()));
  return best;
}

// The markers in the order in which the shape has them.
std::string Names(const Recording& recording, const TrackedSide& side, const Order& order) {
  std::vector<std::string> names(order.size());
  for (std::size_t m = 0; m < order.size(); ++m)
    names[static_cast<std::size_t>(order[m])] =
        recording.markers[static_cast<std::size_t>(side.markers[m])].name;
  return fmt::format("{}", fmt::join(names, ","));
}

}  // namespace

std::string OddShape(const std::vector<Recording>& tracker,
                     const std::vector<const TrackedSide*>& sides,
                     const Eigen::Matrix3Xd& shape,
                     const ShapeSource& source) {
  const std::string name = Quoted(sides.front()->name), path = tracker.front().path;
  if (source.path.empty()) {
    const double misfit = MisfitOfPoses(tracker, sides, shape, source.measured_inverse);
    if (misfit < kOddMisfit) return "";
    return fmt::format(
        "{}: the markers of {} are {:.3g} mm (RMS) from where its poses have them: are the poses "
        "inverted (--measured_inverse), or in another frame?",
        path,
        name,
        1e3 * misfit);
  }
  const std::vector<Eigen::Matrix3Xd> rows = WholeRows(tracker, sides);
  if (rows.empty()) return "";
  const double misfit = Misfit(rows, shape);
  const Candidate best = BestOf(rows, shape);
  const std::string odd = fmt::format(
      "{}: the markers of {} are {:.3g} mm (RMS) from where {} has "
      "them",
      path,
      name,
      1e3 * misfit,
      source.path);
  if (misfit > kRounding && best.misfit * std::sqrt(kClearGain) < misfit)
    return fmt::format("{}, but {:.3g} mm {}{}",
                       odd,
                       1e3 * best.misfit,
                       best.is_mirrored ? "as its mirror image (left-handed axes?)" : "",
                       std::is_sorted(best.order.begin(), best.order.end())
                           ? ""
                           : fmt::format("{}in the order {}",
                                         best.is_mirrored ? " and " : "",
                                         Names(tracker.front(), *sides.front(), best.order)));
  return misfit < kOddMisfit ? "" : odd + ": is it the shape of another body?";
}

}  // namespace hexcal
