// SPDX-License-Identifier: BSD-3-Clause
#include "model/predict.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>

#include "model/data_fault.h"
#include "model/hexapod.h"
#include "model/machine_rows.h"

namespace hexcal {
namespace {

Location RowLocation(const RobotPoses& robot_poses, const RobotPose& row) {
  Location where = robot_poses.where;
  where.line = row.line;
  where.column = 0;
  return where;
}

const HexapodGeometry& HexapodOfLegs(const Dataset& dataset) {
  if (dataset.hexapod) return *dataset.hexapod;
  throw InputError(dataset.robot_poses.where,
                   "leg lengths, but no hexapod that has these legs",
                   "hexapod: with base_joints and platform_joints beside robot_poses");
}

// A start that depends on the row alone makes the pose independent of the order of the rows, and of
// which of them are read. The row before is the second chance, for legs far from their travel's
// centre.
Pose3d PoseOfLegs(const HexapodGeometry& hexapod,
                  const RobotPoses& robot_poses,
                  const RobotPose& row,
                  const Pose3d* previous) {
  const LegLengths lengths = Eigen::Map<const LegLengths>(row.leg_lengths.data());
  const Pose3d neutral = NeutralPose(hexapod, lengths);
  const ForwardKinematicsResult first = ForwardKinematics(hexapod, lengths, neutral);
  if (first.converged) return first.base_from_platform;
  if (previous != nullptr) {
    const ForwardKinematicsResult second = ForwardKinematics(hexapod, lengths, *previous);
    if (second.converged) return second.base_from_platform;
  }
  throw InputError(RowLocation(robot_poses, row),
                   fmt::format("the leg lengths of pose '{}' ({})", row.label, first.message),
                   "lengths, joint centre to joint centre, that a pose of this hexapod reaches");
}

}  // namespace

std::vector<Pose3d> ReportedPoses(const Dataset& dataset) {
  const RobotPoses& robot_poses = dataset.robot_poses;
  // Recorded poses need no hexapod.
  return ReportedPoses(robot_poses,
                       robot_poses.are_leg_lengths ? HexapodOfLegs(dataset) : HexapodGeometry());
}

std::vector<Pose3d> ReportedPoses(const RobotPoses& robot_poses, const HexapodGeometry& hexapod) {
  std::vector<Pose3d> base_from_platform;
  base_from_platform.reserve(robot_poses.rows.size());
  for (const RobotPose& row : robot_poses.rows) {
    const Pose3d* previous = base_from_platform.empty() ? nullptr : &base_from_platform.back();
    base_from_platform.push_back(robot_poses.are_leg_lengths
                                     ? PoseOfLegs(hexapod, robot_poses, row, previous)
                                     : row.base_from_platform);
  }
  return base_from_platform;
}

std::vector<Pose3d> ReportedPoses(const Dataset& dataset, const Machine& machine) {
  const HexapodGeometry* hexapod = HexapodOf(dataset, machine);
  if (dataset.robot_poses.are_leg_lengths && hexapod == nullptr) return ReportedPoses(dataset);
  const bool has_fault =
      std::any_of(machine.effects.begin(), machine.effects.end(), [](const Effect& effect) {
        return FindFaultKind(effect.name) != nullptr;
      });
  const HexapodGeometry& legs = hexapod == nullptr ? HexapodGeometry() : *hexapod;
  return has_fault
             ? ReportedPoses(MendedRobotPoses(dataset.robot_poses, machine.effects, hexapod), legs)
             : ReportedPoses(dataset.robot_poses, legs);
}

std::vector<Matrix6d> ReportedCovariances(const Dataset& dataset,
                                          const std::vector<Pose3d>& base_from_platform) {
  const RobotPoses& robot_poses = dataset.robot_poses;
  if (robot_poses.noise)
    return std::vector<Matrix6d>(base_from_platform.size(), robot_poses.noise->Covariance());
  std::vector<Matrix6d> covariances;
  if (!robot_poses.leg_noise) return covariances;

  const HexapodGeometry& hexapod = HexapodOfLegs(dataset);
  covariances.reserve(base_from_platform.size());
  for (std::size_t i = 0; i < base_from_platform.size(); ++i) {
    const Eigen::FullPivLU<Matrix6d> legs(LegJacobian(hexapod, base_from_platform[i]));
    if (!legs.isInvertible())
      throw InputError(RowLocation(robot_poses, robot_poses.rows[i]),
                       "a singular pose, at which the legs do not hold the platform",
                       "a pose inside the hexapod's workspace");
    const Matrix6d pose_from_legs = *robot_poses.leg_noise * legs.inverse();
    covariances.push_back(pose_from_legs * pose_from_legs.transpose());
  }
  return covariances;
}

std::vector<Pose3d> PredictToolPoses(const Machine& machine,
                                     const std::vector<Pose3d>& base_from_platform) {
  std::vector<Pose3d> world_from_tool;
  world_from_tool.reserve(base_from_platform.size());
  for (const Pose3d& pose : base_from_platform)
    world_from_tool.emplace_back(machine.world_from_base * pose * machine.platform_from_tool);
  return world_from_tool;
}

std::vector<Pose3d> Predict(const Machine& machine, const Dataset& dataset) {
  const std::vector<Pose3d> reported = ReportedPoses(dataset, machine);
  // Nothing to be driven: long tables need no visits.
  if (machine.effects.empty() && !machine.pose_map) return PredictToolPoses(machine, reported);
  MachineRows rows(dataset, machine, reported, EffectSites::kRobotAndMounts);
  std::vector<Pose3d> world_from_tool;
  world_from_tool.reserve(reported.size());
  for (std::size_t i = 0; i < reported.size(); ++i)
    world_from_tool.push_back(rows.Forward(rows.Next()).world_from_tool);
  return world_from_tool;
}

}  // namespace hexcal
