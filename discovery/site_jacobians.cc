// SPDX-License-Identifier: BSD-3-Clause
#include "discovery/site_jacobians.h"

namespace hexcal {
namespace {

using Motion = Corrections<double>;

// d(seen pose) by a tracker that scales and moves, for kind poses: nothing but the pose is known.
Vector6d PoseReadingBy(const Pose3d& seen, const Motion& motion) {
  Vector6d scaled = Vector6d::Zero();
  scaled.head<3>() =
      seen.rotation.conjugate() * Eigen::Vector3d(motion.tracker_scale * seen.translation);
  return scaled - InverseAdjoint(seen) * motion.tracker_twist;
}

}  // namespace

SiteJacobians SitesOf(const Mounts& mounts,
                      const HexapodGeometry* hexapod,
                      const Visit& visit,
                      const Motion& corrections,
                      const ForwardPose& at) {
  SiteJacobians sites;
  const auto derivative = [&](const Motion& motion) {
    return ForwardDerivative(mounts, hexapod, visit, corrections, at, motion);
  };
  for (int k = 0; k < 6; ++k) {
    Motion motion;
    motion.base_twist[k] = 1.0;
    sites.base_twist.col(k) = derivative(motion);
    motion = Motion();
    motion.platform_twist[k] = 1.0;
    sites.platform_twist.col(k) = derivative(motion);
    motion = Motion();
    motion.tool_twist[k] = 1.0;
    sites.tool_twist.col(k) = derivative(motion);
    if (hexapod == nullptr) continue;
    motion = Motion();
    motion.leg[k] = 1.0;
    sites.leg.col(k) = derivative(motion);
    for (int axis = 0; axis < 3; ++axis) {
      motion = Motion();
      motion.base_joints(axis, k) = 1.0;
      sites.base_joints.col(3 * k + axis) = derivative(motion);
      motion = Motion();
      motion.platform_joints(axis, k) = 1.0;
      sites.platform_joints.col(3 * k + axis) = derivative(motion);
    }
  }
  sites.mounts = ForwardByMounts(mounts, corrections, at);
  return sites;
}

Vector6d SiteJacobians::Apply(const Motion& motion) const {
  Vector6d sum = Vector6d::Zero();
  if (!motion.leg.isZero(0.0)) sum += leg * motion.leg;
  if (!motion.base_twist.isZero(0.0)) sum += base_twist * motion.base_twist;
  if (!motion.platform_twist.isZero(0.0)) sum += platform_twist * motion.platform_twist;
  if (!motion.tool_twist.isZero(0.0)) sum += tool_twist * motion.tool_twist;
  using Flat = Eigen::Map<const Eigen::Matrix<double, 18, 1>>;
  if (!motion.base_joints.isZero(0.0)) sum += base_joints * Flat(motion.base_joints.data());
  if (!motion.platform_joints.isZero(0.0))
    sum += platform_joints * Flat(motion.platform_joints.data());
  return sum;
}

bool MovesReadings(const Motion& motion) {
  return motion.tracker_scale != 0.0 || motion.tracker_depth_scale != 0.0 ||
         motion.tracker_distortion != 0.0 || !motion.tracker_twist.isZero(0.0) ||
         !motion.markers[0].isZero(0.0) || !motion.markers[1].isZero(0.0);
}

SeenMotion SeenBy(const SeenPose& seen, const Motion& corrections, const Motion& motion) {
  SeenMotion moved;
  if (!seen.HasShape()) {
    moved.pose = PoseReadingBy(seen.world_from_tool, motion);
    return moved;
  }
  std::array<Vector6d, 2> twists = {Vector6d::Zero(), Vector6d::Zero()};
  std::array<Eigen::VectorXd, 2> shapes;
  for (int b = 0; b < 2; ++b) {
    const SeenBody& body = seen.bodies[b];
    if (body.markers.empty()) continue;
    Eigen::Matrix3Xd displacement(3, body.p_in_tracker.cols());
    const Eigen::Matrix3d rotation = body.tracker_from_body.rotation.toRotationMatrix();
    for (Eigen::Index i = 0; i < displacement.cols(); ++i) {
      const Eigen::Vector3d p = body.tracker_from_body * Eigen::Vector3d(body.p_in_body.col(i));
      displacement.col(i) = TrackerReadingBy(corrections, p, motion);
      if (motion.markers[b].cols() > body.markers[i])
        displacement.col(i) += rotation * motion.markers[b].col(body.markers[i]);
    }
    twists[b] = body.TwistOf(displacement);
    shapes[b] = body.ShapeOf(displacement);
  }
  moved.pose = seen.MeasuredTwist(twists[0], twists[1]);
  moved.shape.resize(shapes[0].size() + shapes[1].size());
  moved.shape << shapes[0], shapes[1];
  return moved;
}

}  // namespace hexcal
