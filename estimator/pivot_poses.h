// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "estimator/observations.h"
#include "geometry/pose.h"
#include "measurement/pivoting.h"

namespace hexcal {

// A pose of the tool while its tip rested in a divot. world: where the poses are given.
struct PivotPose {
  std::string label;
  int line = 0;  // in the table it was read from; 0: none
  Pose3d world_from_tool;
  Matrix6d covariance = Matrix6d::Zero();  // right perturbation in frame T; see PivotNoise
};

enum class PivotNoise {
  kKnown,      // covariance as it is
  kUpToScale,  // covariance but for one factor, the same for all poses
  kUnknown,    // isotropic, one level for positions, one for orientations; covariance is not read
};

struct PivotPoses {
  std::vector<PivotPose> items;
  PivotNoise noise = PivotNoise::kUnknown;
};

// The poses of a pivoting; noise: stated for them all where the file states none, m and rad.
PivotPoses MakePivotPoses(const Pivoting& pivoting, const std::optional<NoiseLevels>& noise);

// Algebra of R_i tip + t_i = pivot. Removing the pivot leaves (R_i - mean R) tip = -(t_i - mean t):
// the tip is determined along directions that the rotations tilt. Reference: Z. Yaniv, Which pivot
// calibration?, Proc. SPIE 9415 (2015).

// How far the poses tilt each direction of the tool: the direction n (unit, frame T) moves by
// rms[k] rad, about its mean; least first.
struct Tilts {
  Eigen::Vector3d rms = Eigen::Vector3d::Zero();
  Eigen::Matrix3d directions = Eigen::Matrix3d::Identity();  // columns; det +1 not promised
};
Tilts FindTilts(const std::vector<PivotPose>& poses);

// Condition number of the stacked [R -1], 3n x 6; infinite where a direction is not tilted at all.
double PivotCondition(const Tilts& tilts);

// Tip in frame T and pivot in frame W, m.
struct TipAndPivot {
  Eigen::Vector3d tip_in_tool = Eigen::Vector3d::Zero();
  Eigen::Vector3d pivot_in_world = Eigen::Vector3d::Zero();
};

// The unweighted least-squares solution, the tip in the span of basis (3 x k, orthonormal columns,
// k from 0; what is lost is left at 0). Indices: which poses; all of them determine the span.
TipAndPivot SolvePivotAlgebraically(const std::vector<PivotPose>& poses,
                                    const std::vector<std::size_t>& indices,
                                    const Eigen::Matrix3Xd& basis);

// R' (R tip + t - pivot): how far the tip is from the pivot, axes of frame T, m.
Eigen::Vector3d PivotError(const Pose3d& world_from_tool, const TipAndPivot& x);

}  // namespace hexcal
