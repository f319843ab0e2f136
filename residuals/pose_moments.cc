// SPDX-License-Identifier: BSD-3-Clause
#include "residuals/pose_moments.h"

#include "residuals/pass_support.h"

namespace hexcal {
namespace {

// Where each sum stands among the accumulators.
enum Sum {
  kTurns = 0,        // A_ij Q_kl, 9 for each A_ij
  kQReported = 81,   // A_ij q_k, 3 for each A_ij
  kReported = 108,   // A
  kMeasured = 117,   // Q
  kQA = 126,         // q a'
  kQQ = 135,         // q q', upper triangle
  kReportedA = 141,  // A' a
  kQ = 144,
  kA = 147,
  kAA = 150,
  kCount = 151
};

HEXCAL_INLINE Vec<Lanes> All(const double* v) {
  return {Lanes{} + v[0], Lanes{} + v[1], Lanes{} + v[2]};
}

HEXCAL_INLINE void AddBlock(const PoseBatch::Block& pose,
                            const Vec<Lanes>& first_q,
                            const Vec<Lanes>& first_a,
                            const Lanes& mask,
                            Lanes* acc) {
  Mat<Lanes> reported = RotationOf(pose.base_from_platform_q);
  Mat<Lanes> measured = RotationOf(pose.world_from_tool_q);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) reported.m[i][j] *= mask, measured.m[i][j] *= mask;
  const Vec<Lanes> q_vector = Scaled(mask, pose.world_from_tool_t - first_q);
  const Vec<Lanes> a_vector = Scaled(mask, pose.base_from_platform_t - first_a);
  const Lanes q[3] = {q_vector.x, q_vector.y, q_vector.z};
  const Lanes a[3] = {a_vector.x, a_vector.y, a_vector.z};
  for (int ij = 0; ij < 9; ++ij) {
    const Lanes entry = reported.m[ij / 3][ij % 3];
    for (int kl = 0; kl < 9; ++kl) acc[kTurns + 9 * ij + kl] += entry * measured.m[kl / 3][kl % 3];
    for (int k = 0; k < 3; ++k) acc[kQReported + 3 * ij + k] += entry * q[k];
    acc[kReported + ij] += entry;
    acc[kMeasured + ij] += measured.m[ij / 3][ij % 3];
  }
  const Vec<Lanes> reported_a = TransposeTimes(reported, a_vector);
  acc[kReportedA] += reported_a.x, acc[kReportedA + 1] += reported_a.y;
  acc[kReportedA + 2] += reported_a.z;
  int triangle = kQQ;
  for (int i = 0; i < 3; ++i) {
    acc[kQ + i] += q[i];
    acc[kA + i] += a[i];
    acc[kAA] += a[i] * a[i];
    for (int j = 0; j < 3; ++j) acc[kQA + 3 * i + j] += q[i] * a[j];
    for (int j = i; j < 3; ++j) acc[triangle++] += q[i] * q[j];
  }
}

HEXCAL_MULTIVERSION
void Accumulate(const PassInput& input, const double* first_q, const double* first_a, double* s) {
  Lanes acc[kCount] = {};
  const Vec<Lanes> q = All(first_q), a = All(first_a);
  for (int b = 0; b < input.blocks; ++b)
    AddBlock(
        input.poses[b], q, a, MaskOf(b + 1 < input.blocks ? kLanes : input.lanes_in_last), acc);
  for (int k = 0; k < kCount; ++k) s[k] = SumOf(acc[k]);
}

}  // namespace

void PoseMoments::Add(const PoseMoments& other) {
  poses += other.poses;
  turns += other.turns;
  reported += other.reported;
  measured += other.measured;
  for (int k = 0; k < 3; ++k) q_reported[k] += other.q_reported[k];
  qq += other.qq;
  qa += other.qa;
  reported_a += other.reported_a;
  q += other.q;
  a += other.a;
  aa += other.aa;
}

PoseMoments PassMoments(const PassInput& input,
                        const Eigen::Vector3d& first_q,
                        const Eigen::Vector3d& first_a) {
  double s[kCount];
  Accumulate(input, first_q.data(), first_a.data(), s);
  PoseMoments moments;
  moments.first_q = first_q;
  moments.first_a = first_a;
  moments.poses = kLanes * (input.blocks - 1) + input.lanes_in_last;
  moments.turns = Eigen::Map<const Eigen::Matrix<double, 9, 9, Eigen::RowMajor>>(s + kTurns);
  moments.reported = MatrixAt(s, kReported);
  moments.measured = MatrixAt(s, kMeasured);
  for (int k = 0; k < 3; ++k)
    for (int ij = 0; ij < 9; ++ij)
      moments.q_reported[k](ij / 3, ij % 3) = s[kQReported + 3 * ij + k];
  moments.qq = SymmetricAt(s, kQQ);
  moments.qa = MatrixAt(s, kQA);
  moments.reported_a = VectorAt(s, kReportedA);
  moments.q = VectorAt(s, kQ);
  moments.a = VectorAt(s, kA);
  moments.aa = s[kAA];
  return moments;
}

}  // namespace hexcal
