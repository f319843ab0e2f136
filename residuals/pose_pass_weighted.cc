// SPDX-License-Identifier: BSD-3-Clause
#include "residuals/lanes_rotation.h"
#include "residuals/pass_support.h"
#include "residuals/pose_pass.h"

namespace hexcal {
namespace {

// Where each sum stands among the accumulators: the four blocks of J' W J that are not told by the
// others, each as base or tool (b, t) and translation or rotation (t, r).
enum Sum {
  kBtBt = 0,   // symmetric, upper triangle
  kBtBr = 6,   // 3 x 3
  kBrBr = 15,  // symmetric
  kBtTt = 21,  // 3 x 3, as the next three
  kBtTr = 30,
  kBrTt = 39,
  kBrTr = 48,
  kTtTt = 57,  // symmetric
  kTtTr = 63,  // 3 x 3
  kTrTr = 72,  // symmetric
  kBase = 78,  // J' W e, 6
  kTool = 84,
  kRho = 90,
  kPosition = 91,
  kOrientation = 92,
  kCount = 93
};

// L = 1 - [e]/2 + c [e]^2.
HEXCAL_INLINE Mat<Lanes> LeftJacobianInverse(const Turn<Lanes>& turn) {
  const Vec<Lanes>& e = turn.vector;
  const Vec<Lanes> h = Scaled(Lanes{} + 0.5, e), ce = Scaled(turn.curvature, e);
  const Lanes xx = ce.x * e.x, yy = ce.y * e.y, zz = ce.z * e.z;
  const Lanes xy = ce.x * e.y, xz = ce.x * e.z, yz = ce.y * e.z;
  return {{{1.0 - yy - zz, xy + h.z, xz - h.y},
           {xy - h.z, 1.0 - xx - zz, yz + h.x},
           {xz + h.y, yz - h.x, 1.0 - xx - yy}}};
}

struct WeightBlocks {
  Mat<Lanes> tt, tr, rr;
};

HEXCAL_INLINE WeightBlocks Unpacked(const Lanes* w) {
  return {{{{w[0], w[1], w[2]}, {w[1], w[6], w[7]}, {w[2], w[7], w[11]}}},
          {{{w[3], w[4], w[5]}, {w[8], w[9], w[10]}, {w[12], w[13], w[14]}}},
          {{{w[15], w[16], w[17]}, {w[16], w[18], w[19]}, {w[17], w[19], w[20]}}}};
}

class Accumulator {
 public:
  HEXCAL_INLINE Accumulator(const Lanes& weight, Lanes* acc) : weight_(weight), acc_(acc) {}

  HEXCAL_INLINE void Add(int k, const Lanes& value) { acc_[k] += weight_ * value; }
  HEXCAL_INLINE void AddVector(int k, const Vec<Lanes>& a) {
    Add(k, a.x), Add(k + 1, a.y), Add(k + 2, a.z);
  }
  HEXCAL_INLINE void AddMatrix(int k, const Mat<Lanes>& a) {
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) Add(k + 3 * i + j, a.m[i][j]);
  }
  HEXCAL_INLINE void AddSymmetric(int k, const Mat<Lanes>& a) {
    Add(k, a.m[0][0]), Add(k + 1, a.m[0][1]), Add(k + 2, a.m[0][2]);
    Add(k + 3, a.m[1][1]), Add(k + 4, a.m[1][2]), Add(k + 5, a.m[2][2]);
  }

 private:
  const Lanes& weight_;
  Lanes* acc_;
};

HEXCAL_INLINE void AddBlock(const PoseBatch::Block& pose,
                            const Lanes* packed_weight,
                            const LaneMounts& mounts,
                            const Lanes& mask,
                            const RobustLoss& loss,
                            bool is_plain,
                            Lanes* acc) {
  const LaneError error = ErrorOf(pose, mounts);
  const WeightBlocks w = Unpacked(packed_weight);
  const Vec<Lanes>&e = error.translation, &turn = error.turn.vector;
  const Vec<Lanes> we_t = w.tt * e + w.tr * turn;
  const Vec<Lanes> we_r = TransposeTimes(w.tr, e) + w.rr * turn;
  Lanes rho = Dot(e, we_t) + Dot(turn, we_r);
  Lanes weight = mask;
  if (!is_plain) ApplyLoss(loss, mask, &rho, &weight);
  Accumulator sums(weight, acc);

  // The derivative by a motion of the tool is -D, D = [1, -[e]x; 0, L]; M = D' W D.
  const Mat<Lanes> l = LeftJacobianInverse(error.turn);
  const Mat<Lanes> m_tr = w.tr * l - TimesSkew(w.tt, e);
  const Mat<Lanes> k_rr = w.rr * l - TransposeTimes(w.tr, SkewOf(e));
  const Mat<Lanes> m_rr = SkewTimes(e, m_tr) + TransposeTimes(l, k_rr);
  const Vec<Lanes> g_r = Cross(e, we_t) + TransposeTimes(l, we_r);
  sums.AddSymmetric(kTtTt, w.tt);
  sums.AddMatrix(kTtTr, m_tr);
  sums.AddSymmetric(kTrTr, m_rr);
  sums.AddVector(kTool, Vec<Lanes>{-we_t.x, -we_t.y, -we_t.z});
  sums.AddVector(kTool + 3, Vec<Lanes>{-g_r.x, -g_r.y, -g_r.z});

  // That by a motion of the base is -D A, A = [R', -R'[u]x; 0, R'].
  const Mat<Lanes>& r = error.base_from_tool_r;
  const Vec<Lanes>& u = error.base_from_tool_t;
  const Mat<Lanes> bt_tt = r * w.tt, bt_tr = r * m_tr;
  const Mat<Lanes> br_tt = SkewTimes(u, bt_tt) + TimesTranspose(r, m_tr);
  const Mat<Lanes> br_tr = SkewTimes(u, bt_tr) + r * m_rr;
  sums.AddMatrix(kBtTt, bt_tt);
  sums.AddMatrix(kBtTr, bt_tr);
  sums.AddMatrix(kBrTt, br_tt);
  sums.AddMatrix(kBrTr, br_tr);
  const Mat<Lanes> bt_bt = TimesTranspose(bt_tt, r);
  sums.AddSymmetric(kBtBt, bt_bt);
  sums.AddMatrix(kBtBr, TimesTranspose(bt_tr, r) - TimesSkew(bt_bt, u));
  sums.AddSymmetric(kBrBr, TimesTranspose(br_tr, r) - TimesSkew(TimesTranspose(br_tt, r), u));
  const Vec<Lanes> base_t = r * we_t, base_r = Cross(u, base_t) + r * g_r;
  sums.AddVector(kBase, Vec<Lanes>{-base_t.x, -base_t.y, -base_t.z});
  sums.AddVector(kBase + 3, Vec<Lanes>{-base_r.x, -base_r.y, -base_r.z});
  acc[kRho] += rho;
  acc[kPosition] += mask * Dot(e, e);
  acc[kOrientation] += mask * Dot(turn, turn);
}

HEXCAL_MULTIVERSION
void Accumulate(const PassInput& input, double* sums) {
  Lanes acc[kCount] = {};
  const LaneMounts mounts(*input.mounts);
  const bool robust = input.loss->kind != LossKind::kNone;
  const Lanes all = Lanes{} + 1.0;
  for (int b = 0; b < input.blocks; ++b) {
    const bool full = b + 1 < input.blocks || input.lanes_in_last == kLanes;
    const Lanes mask = full ? all : MaskOf(input.lanes_in_last);
    AddBlock(input.poses[b],
             input.weights[input.is_common ? 0 : b].w,
             mounts,
             mask,
             *input.loss,
             full && !robust,
             acc);
  }
  for (int k = 0; k < kCount; ++k) sums[k] = SumOf(acc[k]);
}

}  // namespace

WeightedSums PassWeighted(const PassInput& input) {
  double s[kCount];
  Accumulate(input, s);
  WeightedSums sums;
  Matrix12d& n = sums.normal;
  n.block<3, 3>(0, 0) = SymmetricAt(s, kBtBt);
  n.block<3, 3>(0, 3) = MatrixAt(s, kBtBr);
  n.block<3, 3>(3, 3) = SymmetricAt(s, kBrBr);
  n.block<3, 3>(0, 6) = MatrixAt(s, kBtTt);
  n.block<3, 3>(0, 9) = MatrixAt(s, kBtTr);
  n.block<3, 3>(3, 6) = MatrixAt(s, kBrTt);
  n.block<3, 3>(3, 9) = MatrixAt(s, kBrTr);
  n.block<3, 3>(6, 6) = SymmetricAt(s, kTtTt);
  n.block<3, 3>(6, 9) = MatrixAt(s, kTtTr);
  n.block<3, 3>(9, 9) = SymmetricAt(s, kTrTr);
  Mirror(&n);
  for (int k = 0; k < 6; ++k) sums.gradient[k] = s[kBase + k], sums.gradient[6 + k] = s[kTool + k];
  sums.totals = {s[kRho], s[kPosition], s[kOrientation]};
  return sums;
}

void PassTotals::Add(const PassTotals& other) {
  rho += other.rho;
  position_squares += other.position_squares;
  orientation_squares += other.orientation_squares;
}

void WeightedSums::Add(const WeightedSums& other) {
  normal += other.normal;
  gradient += other.gradient;
  totals.Add(other.totals);
}

}  // namespace hexcal
