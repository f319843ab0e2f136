// SPDX-License-Identifier: BSD-3-Clause
#include "residuals/lanes_rotation.h"
#include "residuals/pass_support.h"
#include "residuals/pose_pass.h"

namespace hexcal {
namespace {

// Where each sum stands among the accumulators. With the position's error turned into frame B, v =
// R e_t, its derivative is [-1, [m]x, -R, R [e_t]x] by base and tool, m = u + v; that of the
// rotation e_r is -L [0, R', 0, 1]. R, u: rotation and translation of base_from_tool; L the inverse
// left Jacobian at e_r, G = L' L.
enum Sum {
  kWeight = 0,
  kM = 1,       // m
  kMM = 4,      // m m', upper triangle
  kR = 10,      // R
  kRE = 19,     // R [e_t]x
  kMR = 28,     // [m]x R
  kMRE = 37,    // [m]x R [e_t]x
  kE = 46,      // e_t
  kEE = 49,     // e_t e_t'
  kV = 55,      // v
  kMV = 58,     // m x v
  kG = 61,      // G
  kRG = 67,     // R G
  kRGR = 76,    // R G R'
  kTurn = 82,   // e_r
  kRTurn = 85,  // R e_r
  kTurnSquares = 88,
  kRho = 89,
  kPosition = 90,
  kOrientation = 91,
  kCount = 92
};

template <bool kWeighs>
HEXCAL_INLINE void AddBlock(const PoseBatch::Block& pose,
                            const LaneMounts& mounts,
                            const Lanes& mask,
                            double position_weight,
                            double orientation_weight,
                            const RobustLoss& loss,
                            Lanes* acc) {
  const LaneError error = ErrorOf(pose, mounts);
  const Vec<Lanes>&v = error.v_in_base, &u = error.base_from_tool_t, &e = error.translation;
  const Vec<Lanes>& turn = error.turn.vector;
  const Mat<Lanes>& r = error.base_from_tool_r;
  const Vec<Lanes> m = u + v;
  const Lanes position = Dot(v, v), orientation = Dot(turn, turn);
  Lanes rho = position_weight * position + orientation_weight * orientation;
  Lanes weight = mask;
  if (kWeighs) ApplyLoss(loss, mask, &rho, &weight);

  const auto add = [&](int k, const Lanes& value) { acc[k] += kWeighs ? weight * value : value; };
  const auto add_vector = [&](int k, const Vec<Lanes>& a) {
    add(k, a.x), add(k + 1, a.y), add(k + 2, a.z);
  };
  const auto add_matrix = [&](int k, const Mat<Lanes>& a) {
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) add(k + 3 * i + j, a.m[i][j]);
  };
  // factor a a' + diagonal
  const auto add_square =
      [&](int k, const Vec<Lanes>& a, const Lanes& factor, const Lanes& diagonal) {
        const Vec<Lanes> b = Scaled(factor, a);
        add(k, a.x * b.x + diagonal), add(k + 1, a.x * b.y), add(k + 2, a.x * b.z);
        add(k + 3, a.y * b.y + diagonal), add(k + 4, a.y * b.z), add(k + 5, a.z * b.z + diagonal);
      };
  const Lanes one = Lanes{} + 1.0, zero = {};
  const Mat<Lanes> re = TimesSkew(r, e);
  acc[kWeight] += weight;
  add_vector(kM, m);
  add_square(kMM, m, one, zero);
  add_matrix(kR, r);
  add_matrix(kRE, re);
  add_matrix(kMR, SkewTimes(m, r));
  add_matrix(kMRE, SkewTimes(m, re));
  add_vector(kE, e);
  add_square(kEE, e, one, zero);
  add_vector(kV, v);
  add_vector(kMV, Cross(m, v));

  // G = 1 + g [e_r]^2 with g = 2c - 1/4 - c^2 a^2.
  const Lanes& c = error.turn.curvature;
  const Lanes g = 2.0 * c - 0.25 - c * c * orientation;
  const Lanes diagonal = 1.0 - g * orientation;
  const Vec<Lanes> r_turn = r * turn;
  Mat<Lanes> rg;
  const Vec<Lanes> g_turn = Scaled(g, turn);
  const Lanes row[3] = {r_turn.x, r_turn.y, r_turn.z};
  for (int i = 0; i < 3; ++i) {
    rg.m[i][0] = diagonal * r.m[i][0] + row[i] * g_turn.x;
    rg.m[i][1] = diagonal * r.m[i][1] + row[i] * g_turn.y;
    rg.m[i][2] = diagonal * r.m[i][2] + row[i] * g_turn.z;
  }
  add_square(kG, turn, g, diagonal);
  add_matrix(kRG, rg);
  add_square(kRGR, r_turn, g, diagonal);
  add_vector(kTurn, turn);
  add_vector(kRTurn, r_turn);
  add(kTurnSquares, orientation);
  acc[kRho] += rho;
  acc[kPosition] += kWeighs ? mask * position : position;
  acc[kOrientation] += kWeighs ? mask * orientation : orientation;
}

HEXCAL_MULTIVERSION
void Accumulate(const PassInput& input,
                double position_weight,
                double orientation_weight,
                double* sums) {
  Lanes acc[kCount] = {};
  const LaneMounts mounts(*input.mounts);
  const bool robust = input.loss->kind != LossKind::kNone;
  const int plain = robust ? 0 : input.blocks - (input.lanes_in_last < kLanes ? 1 : 0);
  const Lanes all = Lanes{} + 1.0;
  for (int b = 0; b < plain; ++b)
    AddBlock<false>(
        input.poses[b], mounts, all, position_weight, orientation_weight, *input.loss, acc);
  for (int b = plain; b < input.blocks; ++b) {
    const Lanes mask = b + 1 < input.blocks ? all : MaskOf(input.lanes_in_last);
    AddBlock<true>(
        input.poses[b], mounts, mask, position_weight, orientation_weight, *input.loss, acc);
  }
  for (int k = 0; k < kCount; ++k) sums[k] = SumOf(acc[k]);
}

// The sum of [a]x' [a]x of that of a a'.
Eigen::Matrix3d SkewSquares(const Eigen::Matrix3d& squares) {
  return squares.trace() * Eigen::Matrix3d::Identity() - squares;
}

}  // namespace

void IsotropicSums::Add(const IsotropicSums& other) {
  for (const auto& [mine, its] :
       {std::pair(&position, &other.position), std::pair(&orientation, &other.orientation)}) {
    mine->normal += its->normal;
    mine->gradient += its->gradient;
    mine->squares += its->squares;
    mine->weights += its->weights;
  }
  totals.Add(other.totals);
}

IsotropicSums PassIsotropic(const PassInput& input,
                            double position_weight,
                            double orientation_weight) {
  double s[kCount];
  Accumulate(input, position_weight, orientation_weight, s);
  IsotropicSums sums;
  Matrix12d& p = sums.position.normal;
  p.block<3, 3>(0, 0) = s[kWeight] * Eigen::Matrix3d::Identity();
  p.block<3, 3>(0, 3) = -Skew(VectorAt(s, kM));
  p.block<3, 3>(0, 6) = MatrixAt(s, kR);
  p.block<3, 3>(0, 9) = -MatrixAt(s, kRE);
  p.block<3, 3>(3, 3) = SkewSquares(SymmetricAt(s, kMM));
  p.block<3, 3>(3, 6) = MatrixAt(s, kMR);
  p.block<3, 3>(3, 9) = -MatrixAt(s, kMRE);
  p.block<3, 3>(6, 6) = s[kWeight] * Eigen::Matrix3d::Identity();
  p.block<3, 3>(6, 9) = -Skew(VectorAt(s, kE));
  p.block<3, 3>(9, 9) = SkewSquares(SymmetricAt(s, kEE));
  Mirror(&p);
  sums.position.gradient << -VectorAt(s, kV), -VectorAt(s, kMV), -VectorAt(s, kE),
      Eigen::Vector3d::Zero();
  sums.position.squares = SymmetricAt(s, kEE).trace();
  sums.position.weights = s[kWeight];

  Matrix12d& o = sums.orientation.normal;
  o.block<3, 3>(3, 3) = SymmetricAt(s, kRGR);
  o.block<3, 3>(3, 9) = MatrixAt(s, kRG);
  o.block<3, 3>(9, 9) = SymmetricAt(s, kG);
  Mirror(&o);
  sums.orientation.gradient.segment<3>(3) = -VectorAt(s, kRTurn);
  sums.orientation.gradient.segment<3>(9) = -VectorAt(s, kTurn);
  sums.orientation.squares = s[kTurnSquares];
  sums.orientation.weights = s[kWeight];
  sums.totals = {s[kRho], s[kPosition], s[kOrientation]};
  return sums;
}

}  // namespace hexcal
