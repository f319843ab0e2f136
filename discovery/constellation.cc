// SPDX-License-Identifier: BSD-3-Clause
#include "discovery/constellation.h"

#include <map>

#include "geometry/align_points.h"
#include "geometry/linear_algebra.h"
#include "model/tracker_reading.h"

namespace hexcal {
namespace {

// d(point in the tracker's frame) / d(right twist of tracker_from_body).
Eigen::Matrix<double, 3, 6> PointByTwist(const Pose3d& tracker_from_body,
                                         const Eigen::Vector3d& p_in_body) {
  const Eigen::Matrix3d rotation = tracker_from_body.rotation.toRotationMatrix();
  Eigen::Matrix<double, 3, 6> by;
  by << rotation, -rotation * Skew(p_in_body);
  return by;
}

Eigen::MatrixXd WhitenedRows(const SeenBody& body) {
  Eigen::MatrixXd rows(3 * body.markers.size(), 6);
  for (Eigen::Index i = 0; i < body.p_in_body.cols(); ++i)
    rows.middleRows<3>(3 * i) = body.sigma.col(i).cwiseInverse().asDiagonal() *
                                PointByTwist(body.tracker_from_body, body.p_in_body.col(i));
  return rows;
}

Eigen::VectorXd Whitened(const SeenBody& body, const Eigen::Matrix3Xd& displacement) {
  const Eigen::Matrix3Xd white = displacement.cwiseQuotient(body.sigma);
  return Eigen::Map<const Eigen::VectorXd>(white.data(), white.size());
}

void Fit(SeenBody* body) {
  const Alignment fit = AlignPointsWeighted(body->p_in_tracker, body->p_in_body, body->sigma);
  body->tracker_from_body = fit.a_from_b;
  body->covariance = fit.covariance;
  const SingularValues rows = Decompose(WhitenedRows(*body));
  body->shape_basis = rows.u.rightCols(rows.u.cols() - 6);
}

}  // namespace

Vector6d SeenBody::TwistOf(const Eigen::Matrix3Xd& displacement) const {
  return covariance * (WhitenedRows(*this).transpose() * Whitened(*this, displacement));
}

Eigen::VectorXd SeenBody::ShapeOf(const Eigen::Matrix3Xd& displacement) const {
  return shape_basis.transpose() * Whitened(*this, displacement);
}

Eigen::VectorXd SeenBody::Misfit() const {
  Eigen::Matrix3Xd misfit = p_in_tracker;
  for (Eigen::Index i = 0; i < misfit.cols(); ++i)
    misfit.col(i) -= tracker_from_body * Eigen::Vector3d(p_in_body.col(i));
  return ShapeOf(misfit);
}

// world_from_tool = tracker_from_world^-1 tracker_from_tool: a right twist of the first factor
// stands to the left of the product.
Vector6d SeenPose::MeasuredTwist(const Vector6d& base, const Vector6d& tool) const {
  return tool - InverseAdjoint(world_from_tool) * base;
}

std::vector<SeenPose> SeePoses(const Dataset& dataset,
                               const ToolPoses& tool_poses,
                               const std::vector<Corrections<double>>& corrections) {
  const Measurement& measurement = *dataset.measurement;
  std::vector<SeenPose> poses;
  std::map<int, std::size_t> pose_of_row;
  for (const ToolPose& tool : tool_poses.poses) {
    SeenPose pose;
    pose.row = tool.pose;
    pose.world_from_tool = tool.world_from_tool;
    pose.covariance = tool.covariance;
    pose_of_row[tool.pose] = poses.size();
    poses.push_back(pose);
  }
  const bool has_shape = measurement.kind == Measurement::Kind::kMarkers;
  if (!has_shape) {
    if (!corrections.empty())
      for (SeenPose& pose : poses)
        pose.world_from_tool = PoseOfReading(corrections[pose.row], pose.world_from_tool);
    return poses;
  }

  // Mean readings, marker by marker.
  struct Mean {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    int count = 0;
  };
  std::vector<std::array<std::map<int, Mean>, 2>> means(poses.size());
  for (const MarkerReading& reading : measurement.readings) {
    const auto found = pose_of_row.find(reading.pose);
    if (found == pose_of_row.end()) continue;
    Mean& mean = means[found->second][static_cast<int>(reading.body)][reading.marker];
    mean.sum += reading.p_in_tracker, ++mean.count;
  }
  const Eigen::Vector3d sigma = measurement.marker_sigma.value_or(Eigen::Vector3d::Ones());
  for (std::size_t k = 0; k < poses.size(); ++k) {
    SeenPose& pose = poses[k];
    for (int b = dataset.tracker.is_static ? 1 : 0; b < 2; ++b) {
      const MarkerBody& body = measurement.bodies[b];
      if (body.is_centroid) continue;
      SeenBody& seen = pose.bodies[b];
      const auto n = static_cast<Eigen::Index>(means[k][b].size());
      seen.p_in_tracker.resize(3, n), seen.p_in_body.resize(3, n), seen.sigma.resize(3, n);
      for (const auto& [marker, mean] : means[k][b]) {
        const auto i = static_cast<Eigen::Index>(seen.markers.size());
        seen.markers.push_back(marker);
        seen.p_in_tracker.col(i) = mean.sum / mean.count;
        seen.p_in_body.col(i) = body.p_in_body.col(marker);
        seen.sigma.col(i) = sigma / std::sqrt(static_cast<double>(mean.count));
        if (corrections.empty()) continue;
        const Corrections<double>& here = corrections[pose.row];
        seen.p_in_tracker.col(i) = PointOfReading(here, seen.p_in_tracker.col(i));
        if (here.markers[b].cols() > marker) seen.p_in_body.col(i) += here.markers[b].col(marker);
      }
      Fit(&seen);
    }
    if (corrections.empty() || pose.bodies[1].markers.empty()) continue;
    if (dataset.tracker.is_static)
      pose.world_from_tool =
          tool_poses.tracker_from_world->Inverse() * pose.bodies[1].tracker_from_body;
    else if (!pose.bodies[0].markers.empty())
      pose.world_from_tool =
          pose.bodies[0].tracker_from_body.Inverse() * pose.bodies[1].tracker_from_body;
  }
  return poses;
}

}  // namespace hexcal
