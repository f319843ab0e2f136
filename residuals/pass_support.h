// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "residuals/lanes_rotation.h"
#include "residuals/pose_pass.h"

// One function for every processor, one for those with AVX2 and fused multiply-add; the loader
// chooses.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define HEXCAL_MULTIVERSION __attribute__((target_clones("default", "arch=x86-64-v3")))
#else
#define HEXCAL_MULTIVERSION
#endif

namespace hexcal {

// Base and tool, the same in every lane.
struct LaneMounts {
  Vec<Lanes> base_t, tool_t;
  Quat<Lanes> base_inverse_q, tool_q;

  explicit LaneMounts(const BaseAndTool& mounts)
      : base_t(All(mounts.world_from_base.translation)),
        tool_t(All(mounts.platform_from_tool.translation)),
        base_inverse_q(Conjugate(All(mounts.world_from_base.rotation))),
        tool_q(All(mounts.platform_from_tool.rotation)) {}

  static Lanes All(double value) { return Lanes{} + value; }
  static Vec<Lanes> All(const Eigen::Vector3d& v) { return {All(v.x()), All(v.y()), All(v.z())}; }
  static Quat<Lanes> All(const Eigen::Quaterniond& q) {
    return {All(q.x()), All(q.y()), All(q.z()), All(q.w())};
  }
};

// PoseError of kLanes poses, and what its derivative needs.
struct LaneError {
  Vec<Lanes> base_from_tool_t;  // u
  Mat<Lanes> base_from_tool_r;  // R
  Vec<Lanes> v_in_base;         // measured minus predicted position, frame B
  Vec<Lanes> translation;       // the same in frame T: R' v
  Turn<Lanes> turn;             // measured against predicted rotation, frame T
};

HEXCAL_INLINE LaneError ErrorOf(const PoseBatch::Block& pose, const LaneMounts& mounts) {
  LaneError error;
  const Quat<Lanes> base_from_tool_q = pose.base_from_platform_q * mounts.tool_q;
  error.base_from_tool_t =
      pose.base_from_platform_t + Rotated(pose.base_from_platform_q, mounts.tool_t);
  error.base_from_tool_r = RotationOf(base_from_tool_q);
  error.v_in_base = Rotated(mounts.base_inverse_q, pose.world_from_tool_t - mounts.base_t) -
                    error.base_from_tool_t;
  error.translation = TransposeTimes(error.base_from_tool_r, error.v_in_base);
  error.turn =
      LogOf(Conjugate(base_from_tool_q) * (mounts.base_inverse_q * pose.world_from_tool_q));
  return error;
}

inline Lanes MaskOf(int lanes) {
  Lanes mask;
  for (int l = 0; l < kLanes; ++l) mask[l] = l < lanes ? 1.0 : 0.0;
  return mask;
}

inline double SumOf(const Lanes& lanes) {
  double sum = 0.0;
  for (int l = 0; l < kLanes; ++l) sum += lanes[l];
  return sum;
}

// rho: s in, rho(s) out, 0 where masked; weight: rho'(s), 0 where masked.
inline void ApplyLoss(const RobustLoss& loss, const Lanes& mask, Lanes* rho, Lanes* weight) {
  for (int l = 0; l < kLanes; ++l) {
    double of_lane = 0.0, weight_of_lane = 0.0;
    if (mask[l] > 0.0) loss.Evaluate((*rho)[l], &of_lane, &weight_of_lane);
    (*rho)[l] = of_lane;
    (*weight)[l] = weight_of_lane;
  }
}

// The sums from number k on, as what they are the entries of.
inline Eigen::Vector3d VectorAt(const double* sums, int k) {
  return {sums[k], sums[k + 1], sums[k + 2]};
}

inline Eigen::Matrix3d MatrixAt(const double* sums, int k) {
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(sums + k);
}

inline Eigen::Matrix3d SymmetricAt(const double* sums, int k) {
  Eigen::Matrix3d m;
  m << sums[k], sums[k + 1], sums[k + 2],     //
      sums[k + 1], sums[k + 3], sums[k + 4],  //
      sums[k + 2], sums[k + 4], sums[k + 5];
  return m;
}

// The lower triangle from the upper.
inline void Mirror(Matrix12d* m) {
  m->triangularView<Eigen::StrictlyLower>() = m->transpose().triangularView<Eigen::StrictlyLower>();
}

}  // namespace hexcal
