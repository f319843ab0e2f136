// SPDX-License-Identifier: BSD-3-Clause
#include "model/forward.h"

#include <glog/logging.h>

#include <Eigen/LU>

#include "model/hexapod.h"

namespace hexcal {
namespace {

bool MovesLegs(const Corrections<double>& corrections) {
  return !(corrections.leg.isZero(0.0) && corrections.base_joints.isZero(0.0) &&
           corrections.platform_joints.isZero(0.0));
}

// Plus that leaves x as it is to the last bit where nothing is to be added.
Pose3d Moved(const Pose3d& x, const Vector6d& twist) {
  return twist.isZero(0.0) ? x : Plus(x, twist);
}

// The pose whose Plus by twist is moved.
Pose3d MovedBack(const Pose3d& moved, const Vector6d& twist) {
  if (twist.isZero(0.0)) return moved;
  const Eigen::Quaterniond rotation =
      moved.rotation * Exp(Eigen::Vector3d(twist.tail<3>())).conjugate();
  return {moved.translation - rotation * twist.head<3>(), rotation};
}

Pose3d PoseOf(const Vector6d& twist) {
  return {twist.head<3>(), Exp(Eigen::Vector3d(twist.tail<3>()))};
}

// d(right twist of x [+] twist) where twist moves by motion.
Vector6d PlusByTwist(const Vector6d& twist, const Vector6d& motion) {
  const Eigen::Vector3d turn = twist.tail<3>();
  Vector6d d;
  d << Exp(turn).conjugate() * motion.head<3>(), RightJacobian(turn) * motion.tail<3>();
  return d;
}

HexapodGeometry Corrected(const HexapodGeometry& hexapod, const Corrections<double>& corrections) {
  HexapodGeometry corrected = hexapod;
  corrected.base_joints_in_base += corrections.base_joints;
  corrected.platform_joints_in_platform += corrections.platform_joints;
  return corrected;
}

// d(right twist of the pose that the legs hold): J ξ = δl - u' δa + u' δb, the legs' unit vectors
// u from base to platform, at the corrected joints.
Vector6d LegTwist(const HexapodGeometry& hexapod,
                  const Corrections<double>& corrections,
                  const Pose3d& base_from_platform,
                  const Corrections<double>& motion) {
  const HexapodGeometry corrected = Corrected(hexapod, corrections);
  const Matrix6d jacobian = LegJacobian(corrected, base_from_platform);
  Vector6d lengthening = motion.leg;
  for (int i = 0; i < kNumLegs; ++i) {
    const Eigen::Vector3d u_in_platform = jacobian.block<1, 3>(i, 0).transpose();
    lengthening[i] += (base_from_platform.rotation * u_in_platform).dot(motion.base_joints.col(i)) -
                      u_in_platform.dot(motion.platform_joints.col(i));
  }
  return jacobian.partialPivLu().solve(lengthening);
}

// One more Newton step than the tolerance of forward kinematics asks for: what is left is rounding,
// so that differences of predictions mean something.
Pose3d Polished(const HexapodGeometry& hexapod, const LegLengths& lengths, const Pose3d& pose) {
  const LegLengths misfit = lengths - InverseKinematics(hexapod, pose);
  const Vector6d step = LegJacobian(hexapod, pose).partialPivLu().solve(misfit);
  return Plus(pose, step);
}

}  // namespace

ForwardPose Forward(const Mounts& mounts,
                    const HexapodGeometry* hexapod,
                    const Visit& visit,
                    const Corrections<double>& corrections) {
  ForwardPose result;
  result.base_from_platform = visit.base_from_platform;
  if (MovesLegs(corrections)) {
    CHECK(hexapod != nullptr) << "corrected legs without a hexapod";
    const LegLengths lengths =
        InverseKinematics(*hexapod, visit.base_from_platform) + corrections.leg;
    const HexapodGeometry corrected = Corrected(*hexapod, corrections);
    const ForwardKinematicsResult found =
        ForwardKinematics(corrected, lengths, visit.base_from_platform);
    result.reached = found.converged;
    if (found.converged)
      result.base_from_platform = Polished(corrected, lengths, found.base_from_platform);
  }
  result.base_from_platform = Moved(result.base_from_platform, corrections.platform_twist);
  result.world_from_tool = Moved(mounts.world_from_base, corrections.base_twist) *
                           result.base_from_platform *
                           Moved(mounts.platform_from_tool, corrections.tool_twist);
  return result;
}

Vector6d ForwardDerivative(const Mounts& mounts,
                           const HexapodGeometry* hexapod,
                           const Visit& /*visit*/,
                           const Corrections<double>& corrections,
                           const ForwardPose& at,
                           const Corrections<double>& motion) {
  const Pose3d platform_from_tool = Moved(mounts.platform_from_tool, corrections.tool_twist);
  Vector6d in_tool = PlusByTwist(corrections.tool_twist, motion.tool_twist);
  Vector6d in_platform = PlusByTwist(corrections.platform_twist, motion.platform_twist);
  if (MovesLegs(motion)) {
    CHECK(hexapod != nullptr) << "corrected legs without a hexapod";
    const Pose3d held = MovedBack(at.base_from_platform, corrections.platform_twist);
    in_platform += InverseAdjoint(PoseOf(corrections.platform_twist)) *
                   LegTwist(*hexapod, corrections, held, motion);
  }
  if (!motion.base_twist.isZero(0.0))
    in_platform += InverseAdjoint(at.base_from_platform) *
                   PlusByTwist(corrections.base_twist, motion.base_twist);
  in_tool += InverseAdjoint(platform_from_tool) * in_platform;
  return in_tool;
}

Eigen::Matrix<double, 6, 12> ForwardByMounts(const Mounts& mounts,
                                             const Corrections<double>& corrections,
                                             const ForwardPose& at) {
  const Pose3d platform_from_tool = Moved(mounts.platform_from_tool, corrections.tool_twist);
  Eigen::Matrix<double, 6, 12> jacobian;
  jacobian << InverseAdjoint(at.base_from_platform * platform_from_tool) *
                  InverseAdjoint(PoseOf(corrections.base_twist)),
      InverseAdjoint(PoseOf(corrections.tool_twist));
  return jacobian;
}

}  // namespace hexcal
