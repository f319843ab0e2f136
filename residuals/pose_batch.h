// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "geometry/pose.h"
#include "residuals/lanes.h"

namespace hexcal {

// Reported and measured poses as the streaming pass wants them: kLanes side by side, 112 bytes a
// pose. Frames as in Eq. (1), m.
class PoseBatch {
 public:
  struct alignas(sizeof(Lanes)) Block {
    Vec<Lanes> base_from_platform_t;
    Quat<Lanes> base_from_platform_q;
    Vec<Lanes> world_from_tool_t;
    Quat<Lanes> world_from_tool_q;
  };

  void Reserve(std::size_t poses) { blocks_.reserve((poses + kLanes - 1) / kLanes); }
  void Add(const Pose3d& base_from_platform, const Pose3d& world_from_tool);

  void Get(std::size_t pose, Pose3d* base_from_platform, Pose3d* world_from_tool) const;

  std::size_t size() const { return size_; }
  // Lanes of the last block beyond size() hold one of its poses.
  const std::vector<Block>& blocks() const { return blocks_; }

 private:
  std::vector<Block> blocks_;
  std::size_t size_ = 0;
};

// The inverse covariances of the poses' errors, 1/m^2, 1/(m rad), 1/rad^2, frame T.
class PoseWeights {
 public:
  enum class Kind {
    kIsotropic,  // one level for positions, one for orientations
    kCommon,     // one 6 x 6 for all poses
    kPerPose,    // 168 bytes a pose
  };
  // The 21 different entries of a symmetric 6 x 6 by rows of the upper triangle, one pose a lane.
  struct alignas(sizeof(Lanes)) Block {
    Lanes w[21];
  };

  // 1-sigma of a coordinate, m, and of an angle, rad.
  static PoseWeights Isotropic(double position_sigma, double orientation_sigma);
  // kIsotropic where that is what the covariance is.
  static PoseWeights Common(const Matrix6d& covariance);
  static PoseWeights PerPose(std::size_t poses);
  // kPerPose: in the order of the batch.
  void Add(const Matrix6d& covariance);

  Kind kind() const { return kind_; }
  double position() const { return position_; }        // kIsotropic, 1/m^2
  double orientation() const { return orientation_; }  // kIsotropic, 1/rad^2
  const Block& common() const { return common_; }
  const std::vector<Block>& blocks() const { return blocks_; }

 private:
  Kind kind_ = Kind::kIsotropic;
  double position_ = 1.0, orientation_ = 1.0;
  Block common_ = {};
  std::vector<Block> blocks_;
  std::size_t size_ = 0;
};

}  // namespace hexcal
