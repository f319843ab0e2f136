// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/marker_sight.h"

#include <cmath>
#include <map>
#include <utility>

#include "geometry/align_points.h"
#include "measurement/marker_body.h"
#include "model/tracker_reading.h"

namespace hexcal {

MarkerSight::MarkerSight(const Dataset& dataset, const std::vector<int>& rows)
    : dataset_(dataset), rows_(rows) {
  if (dataset.measurement->kind == Measurement::Kind::kMarkers) Gather();
}

void MarkerSight::Gather() {
  const Measurement& measurement = *dataset_.measurement;
  std::map<int, int> place_of_row;
  for (std::size_t i = 0; i < rows_.size(); ++i) place_of_row[rows_[i]] = static_cast<int>(i);
  struct Mean {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    int count = 0;
  };
  // Ordered, so that sums do not depend on the order of the table.
  std::array<std::map<std::pair<int, int>, Mean>, 2> means;
  for (const MarkerReading& reading : measurement.readings) {
    Mean& mean = means[static_cast<int>(reading.body)][{reading.pose, reading.marker}];
    mean.sum += reading.p_in_tracker, ++mean.count;
  }
  const Eigen::Vector3d sigma = measurement.marker_sigma.value_or(Eigen::Vector3d::Ones());
  for (int body = 0; body < 2; ++body) {
    const bool is_common = body == 0 && dataset_.tracker.is_static;
    readings_[body].resize(is_common ? 1 : rows_.size());
    for (const auto& [key, mean] : means[body]) {
      const auto place = place_of_row.find(key.first);
      if (!is_common && place == place_of_row.end()) continue;
      readings_[body][is_common ? 0 : place->second].push_back(
          {key.first, key.second, mean.sum / mean.count, sigma / std::sqrt(1.0 * mean.count)});
    }
    if (measurement.bodies[body].is_centroid) continue;
    for (const Readings& readings : readings_[body]) {
      misfit_rows_ += 3 * static_cast<int>(readings.size());
      misfit_freedom_ += 3 * static_cast<int>(readings.size()) - 6;
    }
  }
}

Pose3d MarkerSight::Fit(int body,
                        const Readings& readings,
                        const std::vector<Corrections<double>>& corrections,
                        Eigen::VectorXd* misfit,
                        int* filled) const {
  const MarkerBody& markers = dataset_.measurement->bodies[body];
  const auto n = static_cast<Eigen::Index>(readings.size());
  Eigen::Matrix3Xd p_in_tracker(3, n), p_in_body(3, n), sigma(3, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const MeanReading& reading = readings[i];
    const Corrections<double>& here = corrections[reading.row];
    p_in_tracker.col(i) = PointOfReading(here, reading.p_in_tracker);
    sigma.col(i) = reading.sigma;
    if (markers.is_centroid) continue;
    p_in_body.col(i) = markers.p_in_body.col(reading.marker);
    if (here.markers[body].cols() > 0) p_in_body.col(i) += here.markers[body].col(reading.marker);
  }
  if (markers.is_centroid) return CentroidFrame(p_in_tracker, sigma, markers.x_axis).a_from_b;
  if (!p_in_tracker.allFinite()) {
    misfit->segment(*filled, 3 * n).setConstant(std::nan(""));
    *filled += static_cast<int>(3 * n);
    return {Eigen::Vector3d::Constant(std::nan("")), Eigen::Quaterniond::Identity()};
  }
  const Pose3d tracker_from_body = AlignPointsWeighted(p_in_tracker, p_in_body, sigma).a_from_b;
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Vector3d predicted = tracker_from_body * Eigen::Vector3d(p_in_body.col(i));
    misfit->segment<3>(*filled) = (p_in_tracker.col(i) - predicted).cwiseQuotient(sigma.col(i));
    *filled += 3;
  }
  return tracker_from_body;
}

Sight MarkerSight::See(const std::vector<Corrections<double>>& corrections) const {
  Sight sight;
  sight.world_from_tool.reserve(rows_.size());
  if (dataset_.measurement->kind == Measurement::Kind::kPoses) {
    std::map<int, Pose3d> measured;
    for (const MeasuredPose& pose : dataset_.measurement->poses)
      measured[pose.pose] = pose.world_from_tool;
    for (const int row : rows_)
      sight.world_from_tool.push_back(PoseOfReading(corrections[row], measured.at(row)));
    return sight;
  }
  sight.misfit.resize(misfit_rows_);
  int filled = 0;
  Pose3d tracker_from_world;
  if (dataset_.tracker.is_static)
    tracker_from_world = Fit(0, readings_[0][0], corrections, &sight.misfit, &filled);
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    if (!dataset_.tracker.is_static)
      tracker_from_world = Fit(0, readings_[0][i], corrections, &sight.misfit, &filled);
    const Pose3d tracker_from_tool = Fit(1, readings_[1][i], corrections, &sight.misfit, &filled);
    sight.world_from_tool.emplace_back(tracker_from_world.Inverse() * tracker_from_tool);
  }
  return sight;
}

}  // namespace hexcal
