// SPDX-License-Identifier: BSD-3-Clause
#include "residuals/pose_batch.h"

#include <Eigen/Cholesky>

namespace hexcal {
namespace {

// The first pose of a block fills all its lanes.
void SetLanes(Lanes* lanes, int lane, double value) {
  if (lane == 0)
    *lanes = Lanes{} + value;
  else
    (*lanes)[lane] = value;
}

void SetPose(const Pose3d& pose, int lane, Vec<Lanes>* t, Quat<Lanes>* q) {
  SetLanes(&t->x, lane, pose.translation.x());
  SetLanes(&t->y, lane, pose.translation.y());
  SetLanes(&t->z, lane, pose.translation.z());
  SetLanes(&q->x, lane, pose.rotation.x());
  SetLanes(&q->y, lane, pose.rotation.y());
  SetLanes(&q->z, lane, pose.rotation.z());
  SetLanes(&q->w, lane, pose.rotation.w());
}

Pose3d PoseAt(const Vec<Lanes>& t, const Quat<Lanes>& q, int lane) {
  return {Eigen::Vector3d(t.x[lane], t.y[lane], t.z[lane]),
          Eigen::Quaterniond(q.w[lane], q.x[lane], q.y[lane], q.z[lane])};
}

void SetInformation(const Matrix6d& covariance, int lane, PoseWeights::Block* block) {
  const Matrix6d information = covariance.llt().solve(Matrix6d::Identity());
  int k = 0;
  for (int i = 0; i < 6; ++i)
    for (int j = i; j < 6; ++j) SetLanes(&block->w[k++], lane, information(i, j));
}

}  // namespace

void PoseBatch::Add(const Pose3d& base_from_platform, const Pose3d& world_from_tool) {
  const int lane = static_cast<int>(size_ % kLanes);
  if (lane == 0) blocks_.emplace_back();
  Block& block = blocks_.back();
  SetPose(base_from_platform, lane, &block.base_from_platform_t, &block.base_from_platform_q);
  SetPose(world_from_tool, lane, &block.world_from_tool_t, &block.world_from_tool_q);
  ++size_;
}

void PoseBatch::Get(std::size_t pose, Pose3d* base_from_platform, Pose3d* world_from_tool) const {
  const Block& block = blocks_[pose / kLanes];
  const int lane = static_cast<int>(pose % kLanes);
  *base_from_platform = PoseAt(block.base_from_platform_t, block.base_from_platform_q, lane);
  *world_from_tool = PoseAt(block.world_from_tool_t, block.world_from_tool_q, lane);
}

PoseWeights PoseWeights::Isotropic(double position_sigma, double orientation_sigma) {
  PoseWeights weights;
  weights.position_ = 1.0 / (position_sigma * position_sigma);
  weights.orientation_ = 1.0 / (orientation_sigma * orientation_sigma);
  return weights;
}

PoseWeights PoseWeights::Common(const Matrix6d& covariance) {
  const double position = covariance(0, 0), orientation = covariance(3, 3);
  Vector6d levels;
  levels << position, position, position, orientation, orientation, orientation;
  if (covariance == Matrix6d(levels.asDiagonal()))  // the pass has half the work
    return Isotropic(std::sqrt(position), std::sqrt(orientation));
  PoseWeights weights;
  weights.kind_ = Kind::kCommon;
  SetInformation(covariance, 0, &weights.common_);
  return weights;
}

PoseWeights PoseWeights::PerPose(std::size_t poses) {
  PoseWeights weights;
  weights.kind_ = Kind::kPerPose;
  weights.blocks_.reserve((poses + kLanes - 1) / kLanes);
  return weights;
}

void PoseWeights::Add(const Matrix6d& covariance) {
  const int lane = static_cast<int>(size_ % kLanes);
  if (lane == 0) blocks_.emplace_back();
  SetInformation(covariance, lane, &blocks_.back());
  ++size_;
}

}  // namespace hexcal
