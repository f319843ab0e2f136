// SPDX-License-Identifier: BSD-3-Clause
#include "model/tracker_reading.h"

#include <Eigen/LU>
#include <limits>

namespace hexcal {
namespace {

constexpr int kMaxIterations = 50;
constexpr double kTolerance = 1e-15;  // of the reading

// reading_from_tracker: where the tracker really stands.
Pose3d Stand(const Corrections<double>& corrections) {
  return {corrections.tracker_twist.head<3>(),
          Exp(Eigen::Vector3d(corrections.tracker_twist.tail<3>()))};
}

bool Stays(const Corrections<double>& corrections) { return corrections.tracker_twist.isZero(0.0); }

bool ReadsTruly(const Corrections<double>& corrections) {
  return corrections.tracker_scale == 0.0 && corrections.tracker_depth_scale == 0.0 &&
         corrections.tracker_distortion == 0.0;
}

// The reading of a point q of the frame in which the tracker really stands.
Eigen::Vector3d Read(const Corrections<double>& corrections, const Eigen::Vector3d& q) {
  const double off_axis = corrections.tracker_distortion * (q.x() * q.x() + q.y() * q.y());
  const double scale = 1.0 + corrections.tracker_scale;
  return {(scale + off_axis) * q.x(),
          (scale + off_axis) * q.y(),
          (scale + corrections.tracker_depth_scale) * q.z()};
}

Eigen::Matrix3d ReadByPoint(const Corrections<double>& corrections, const Eigen::Vector3d& q) {
  const double x = q.x(), y = q.y(), c = corrections.tracker_distortion;
  const double scale = 1.0 + corrections.tracker_scale;
  Eigen::Matrix3d m;
  m << scale + c * (3 * x * x + y * y), 2 * c * x * y, 0,  //
      2 * c * x * y, scale + c * (x * x + 3 * y * y), 0,   //
      0, 0, scale + corrections.tracker_depth_scale;
  return m;
}

Eigen::Vector3d Unread(const Corrections<double>& corrections, const Eigen::Vector3d& reading) {
  Eigen::Vector3d q = reading;
  for (int i = 0; i < kMaxIterations; ++i) {
    const Eigen::Vector3d misfit = Read(corrections, q) - reading;
    if (misfit.norm() <= kTolerance * reading.norm()) return q;
    const Eigen::Vector3d step = ReadByPoint(corrections, q).inverse() * misfit;
    q -= step;
    if (step.norm() <= kTolerance * q.norm()) return q;
  }
  return Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
}

}  // namespace

Eigen::Vector3d TrackerReading(const Corrections<double>& corrections, const Eigen::Vector3d& p) {
  const Eigen::Vector3d q = Stays(corrections) ? p : Stand(corrections).Inverse() * p;
  return ReadsTruly(corrections) ? q : Read(corrections, q);
}

Eigen::Matrix3d TrackerReadingByPoint(const Corrections<double>& corrections,
                                      const Eigen::Vector3d& p) {
  const Pose3d stand_from_tracker = Stand(corrections).Inverse();
  return ReadByPoint(corrections, stand_from_tracker * p) *
         stand_from_tracker.rotation.toRotationMatrix();
}

Eigen::Vector3d TrackerReadingBy(const Corrections<double>& corrections,
                                 const Eigen::Vector3d& p,
                                 const Corrections<double>& motion) {
  const Pose3d stand = Stand(corrections);
  const Eigen::Vector3d q = stand.Inverse() * p;
  const Eigen::Vector3d turn =
      RightJacobian(corrections.tracker_twist.tail<3>()) * motion.tracker_twist.tail<3>();
  // The tracker moves, so the point moves the other way in its frame.
  const Eigen::Vector3d q_by =
      q.cross(turn) - stand.rotation.conjugate() * motion.tracker_twist.head<3>();
  const double squared = q.x() * q.x() + q.y() * q.y();
  return ReadByPoint(corrections, q) * q_by + motion.tracker_scale * q +
         motion.tracker_depth_scale * Eigen::Vector3d(0, 0, q.z()) +
         motion.tracker_distortion * squared * Eigen::Vector3d(q.x(), q.y(), 0);
}

Eigen::Vector3d PointOfReading(const Corrections<double>& corrections,
                               const Eigen::Vector3d& reading) {
  const Eigen::Vector3d q = ReadsTruly(corrections) ? reading : Unread(corrections, reading);
  return Stays(corrections) ? q : Eigen::Vector3d(Stand(corrections) * q);
}

Pose3d TrackerPoseReading(const Corrections<double>& corrections, const Pose3d& world_from_tool) {
  Pose3d reading =
      Stays(corrections) ? world_from_tool : Stand(corrections).Inverse() * world_from_tool;
  reading.translation *= 1.0 + corrections.tracker_scale;
  return reading;
}

Pose3d PoseOfReading(const Corrections<double>& corrections, const Pose3d& reading) {
  Pose3d pose = reading;
  pose.translation /= 1.0 + corrections.tracker_scale;
  return Stays(corrections) ? pose : Stand(corrections) * pose;
}

}  // namespace hexcal
