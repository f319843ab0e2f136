// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/marker_observations.h"

#include <glog/logging.h>
#include <Eigen/Cholesky>

#include <algorithm>

#include "geometry/align_points.h"
#include "measurement/marker_body.h"

namespace hexcal {
namespace {

// Frames in excess of the first that tell one axis' sigma from another's: each to 10 %.
constexpr int kEnoughFrames = 50;

// L with C = L L', for a C that may be singular.
Matrix6d Root(const Matrix6d& covariance) {
  const Eigen::LDLT<Matrix6d> ldlt(covariance);
  const Matrix6d lower = ldlt.matrixL();
  const Vector6d root = ldlt.vectorD().cwiseMax(0.0).cwiseSqrt();
  return ldlt.transpositionsP().transpose() * Matrix6d(lower * root.asDiagonal());
}

// A marker's readings in one pose.
struct Frames {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  int count = 0;
};
using BodyFrames = std::vector<Frames>;  // by marker

class Maker {
 public:
  Maker(const Dataset& dataset, const Observations& observations)
      : dataset_(dataset), measurement_(*dataset.measurement), observations_(observations) {
    CHECK(measurement_.kind == Measurement::Kind::kMarkers) << "there are no readings of markers";
    for (int b = 0; b < 2; ++b)
      frames_[b].resize(dataset.robot_poses.rows.size(),
                        BodyFrames(measurement_.bodies[b].markers.size()));
    for (const MarkerReading& r : measurement_.readings) {
      Frames& frames = frames_[static_cast<int>(r.body)][r.pose][r.marker];
      frames.sum += r.p_in_tracker;
      ++frames.count;
    }
  }

  MarkerObservations Run() {
    result_.sigma = measurement_.marker_sigma;
    result_.data.tracker_is_static = dataset_.tracker.is_static;
    result_.data.has_robot_noise = observations_.has_robot_noise;
    for (int b = 0; b < 2; ++b) AddBody(b);
    AddPoses();
    SetStarts();
    SetPureError();
    return std::move(result_);
  }

 private:
  void AddBody(int b) {
    const MarkerBody& body = measurement_.bodies[b];
    result_.data.bodies[b] = {body.p_in_body, body.is_centroid, body.x_axis};
    for (const std::string& marker : body.markers)
      result_.labels[b].push_back((b == 0 ? "base/" : "tool/") + marker);
  }

  // Items stand in the order of the rows.
  void AddPoses() {
    const auto& rows = dataset_.robot_poses.rows;
    std::size_t item = 0;
    for (std::size_t row = 0; row < rows.size(); ++row) {
      const bool is_used =
          item < observations_.items.size() && observations_.items[item].label == rows[row].label;
      if (is_used || dataset_.tracker.is_static)
        AddPose(row, is_used ? static_cast<int>(item) : -1);
      if (is_used) ++item;
    }
    CHECK_EQ(item, observations_.items.size()) << "the observations are not this dataset's";
  }

  void AddPose(std::size_t row, int item) {
    MarkerPose pose;
    pose.first_base = NumReadings();
    AddReadings(frames_[0][row]);
    pose.first_tool = NumReadings();
    if (item >= 0) AddReadings(frames_[1][row]);
    pose.end = NumReadings();
    if (pose.end == pose.first_base) return;
    if (item >= 0) {
      const Observation& o = observations_.items[item];
      pose.base_from_platform = o.base_from_platform;
      pose.world_from_tool = o.world_from_tool;
      if (observations_.has_robot_noise) pose.robot_root = Root(o.robot_covariance);
    }
    result_.data.poses.push_back(pose);
    result_.item_of_pose.push_back(item);
  }

  int NumReadings() const { return static_cast<int>(result_.data.readings.size()); }

  void AddReadings(const BodyFrames& body) {
    for (std::size_t m = 0; m < body.size(); ++m)
      if (body[m].count > 0)
        result_.data.readings.push_back(
            {static_cast<int>(m), body[m].count, body[m].sum / body[m].count});
  }

  // Where the bodies stand, taken alone, and the shape of those whose frame is their centroid's.
  void SetStarts() {
    std::array<Eigen::Vector3d, 2> sum = {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
    std::array<int, 2> count = {0, 0};
    for (MarkerPose& pose : result_.data.poses) {
      AddShape(1, pose.first_tool, pose.end, &sum[1], &count[1]);
      if (dataset_.tracker.is_static) {
        pose.tracker_from_world = *observations_.tracker_from_world;
        continue;
      }
      pose.tracker_from_world = TrackerFromBody(0, pose.first_base, pose.first_tool);
      AddShape(0, pose.first_base, pose.first_tool, &sum[0], &count[0]);
    }
    if (dataset_.tracker.is_static && result_.data.bodies[0].is_centroid) {
      sum[0] = ShapeOf(0, *observations_.tracker_from_world, MeansOfAllPoses());
      count[0] = 1;
    }
    for (int b = 0; b < 2; ++b) {
      MarkerShape& body = result_.data.bodies[b];
      if (body.is_centroid) body.p_in_body = body.FromParameters(sum[b] / count[b]);
    }
  }

  Eigen::Matrix3Xd MeansOfAllPoses() const {
    Eigen::Matrix3Xd means(3, 3);
    for (int m = 0; m < 3; ++m) {
      Frames all;
      for (const BodyFrames& pose : frames_[0]) {
        all.sum += pose[m].sum;
        all.count += pose[m].count;
      }
      means.col(m) = all.sum / all.count;
    }
    return means;
  }

  Eigen::Matrix3Xd Seen(int first, int end) const {
    Eigen::Matrix3Xd p(3, end - first);
    for (int i = first; i < end; ++i) p.col(i - first) = result_.data.readings[i].p_in_tracker;
    return p;
  }

  Pose3d TrackerFromBody(int b, int first, int end) const {
    const Eigen::Matrix3Xd seen = Seen(first, end);
    const MarkerBody& body = measurement_.bodies[b];
    if (body.is_centroid) return CentroidFrame(seen, Eigen::Matrix3d::Ones(), body.x_axis).a_from_b;
    Eigen::Matrix3Xd known(3, end - first);
    for (int i = first; i < end; ++i)
      known.col(i - first) = body.p_in_body.col(result_.data.readings[i].marker);
    return AlignPoints(seen, known);
  }

  Eigen::Vector3d ShapeOf(int b, const Pose3d& tracker_from_body, const Eigen::Matrix3Xd& p) const {
    const Pose3d body_from_tracker = tracker_from_body.Inverse();
    MarkerShape shape = result_.data.bodies[b];
    shape.p_in_body.resize(3, 3);
    for (int m = 0; m < 3; ++m)
      shape.p_in_body.col(m) = body_from_tracker * Eigen::Vector3d(p.col(m));
    return shape.Parameters();
  }

  void AddShape(int b, int first, int end, Eigen::Vector3d* sum, int* count) const {
    if (!result_.data.bodies[b].is_centroid || end - first < 3) return;
    *sum += ShapeOf(b, TrackerFromBody(b, first, end), Seen(first, end));
    ++*count;
  }

  void SetPureError() {
    for (const MarkerReading& r : measurement_.readings) {
      const Frames& all = frames_[static_cast<int>(r.body)][r.pose][r.marker];
      result_.pure_error.squares += (r.p_in_tracker - all.sum / all.count).cwiseAbs2();
    }
    for (const auto& body : frames_)
      for (const BodyFrames& pose : body)
        for (const Frames& marker : pose)
          result_.pure_error.degrees_of_freedom += std::max(marker.count - 1, 0);
  }

  const Dataset& dataset_;
  const Measurement& measurement_;
  const Observations& observations_;
  std::array<std::vector<BodyFrames>, 2> frames_;  // by body, pose
  MarkerObservations result_;
};

}  // namespace

std::optional<Eigen::Vector3d> PureError::Sigma() const {
  if (degrees_of_freedom < kEnoughFrames || !(squares.minCoeff() > 0.0)) return std::nullopt;
  return (squares / degrees_of_freedom).cwiseSqrt();
}

int MarkerObservations::NumParameters() const {
  const int own_trackers = data.tracker_is_static ? 0 : static_cast<int>(data.poses.size());
  return MarkerLayout(data).size + Pose3d::kNumDof * own_trackers;
}

MarkerObservations Restricted(const MarkerObservations& markers,
                              const Observations& all,
                              const Observations& some) {
  std::vector<int> new_item(all.items.size(), -1);
  std::size_t next = 0;
  for (std::size_t i = 0; i < all.items.size(); ++i)
    if (next < some.items.size() && some.items[next].label == all.items[i].label)
      new_item[i] = static_cast<int>(next++);
  CHECK_EQ(next, some.items.size()) << "these are not items of all";

  MarkerObservations kept = markers;
  kept.data.poses.clear();
  kept.data.readings.clear();
  kept.item_of_pose.clear();
  for (std::size_t i = 0; i < markers.data.poses.size(); ++i) {
    const int old_item = markers.item_of_pose[i];
    const int item = old_item < 0 ? -1 : new_item[old_item];
    const bool is_tool_kept = item >= 0;
    if (!is_tool_kept && !markers.data.tracker_is_static) continue;
    MarkerPose pose = markers.data.poses[i];
    const auto first = markers.data.readings.begin();
    const int end = is_tool_kept ? pose.end : pose.first_tool;
    if (end == pose.first_base) continue;
    const int shift = static_cast<int>(kept.data.readings.size()) - pose.first_base;
    kept.data.readings.insert(kept.data.readings.end(), first + pose.first_base, first + end);
    pose.first_base += shift;
    pose.first_tool += shift;
    pose.end = end + shift;
    kept.data.poses.push_back(pose);
    kept.item_of_pose.push_back(item);
  }
  return kept;
}

MarkerObservations MakeMarkerObservations(const Dataset& dataset,
                                          const Observations& observations) {
  return Maker(dataset, observations).Run();
}

}  // namespace hexcal
