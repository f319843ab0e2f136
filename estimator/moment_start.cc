// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/moment_start.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "estimator/polish.h"
#include "estimator/spd_factor.h"
#include "residuals/pass_support.h"

namespace hexcal {
namespace {

constexpr double kSafePivot = 1e-8, kShrinks = 0.5;
constexpr double kSmallestTurn = 1e-3;  // rad: below it there is no spread
constexpr int kMaxInverseSteps = 20, kMaxNewtonSteps = 20, kMaxSteps = 10;
constexpr double kSettled = 1e-6;  // of a unit vector
// Above 1, the largest that an eigenvalue of Shah's matrix can be.
constexpr double kShift = 1.0 + 1e-6;
// In standard deviations: angles in place of entries move the solution further.
constexpr double kLastStep = 1e-7;

// The nearest rotation to what is nearly the multiple of one, by Newton's iteration. Nothing where
// it is not.
std::optional<Eigen::Matrix3d> NearRotation(const Eigen::Matrix3d& m) {
  Eigen::Matrix3d r = m * (std::sqrt(3.0) / m.norm());
  if (!(r.determinant() > 0.0)) return std::nullopt;
  for (int k = 0; k < kMaxNewtonSteps; ++k) {
    const Eigen::Matrix3d gap = Eigen::Matrix3d::Identity() - r.transpose() * r;
    const double size = gap.squaredNorm();
    if (!(size < 1.0)) return std::nullopt;
    r += 0.5 * r * gap;
    if (size < kSettled * kSettled) return r;
  }
  return std::nullopt;
}

// The axis v of (m - m') / 2 = [v]x.
Eigen::Vector3d SkewPart(const Eigen::Matrix3d& m) {
  return 0.5 * Eigen::Vector3d(m(2, 1) - m(1, 2), m(0, 2) - m(2, 0), m(1, 0) - m(0, 1));
}

// The sum of [m]x A from those of m_k A.
Eigen::Matrix3d CrossedRows(const Eigen::Matrix3d m_reported[3]) {
  Eigen::Matrix3d sum;
  sum.row(0) = m_reported[1].row(2) - m_reported[2].row(1);
  sum.row(1) = m_reported[2].row(0) - m_reported[0].row(2);
  sum.row(2) = m_reported[0].row(1) - m_reported[1].row(0);
  return sum;
}

// The sum of A' z Q, what the poses take the tool's rotation to be where z' is the base's.
Eigen::Matrix3d ToolTurns(const Matrix9d& turns, const Eigen::Matrix3d& z) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k)
        for (int l = 0; l < 3; ++l) sum(j, l) += z(i, k) * turns(3 * i + j, 3 * k + l);
  return sum;
}

// The sum of Q r' A', what they take the base's to be where r is the tool's.
Eigen::Matrix3d BaseTurns(const Matrix9d& turns, const Eigen::Matrix3d& r) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k)
        for (int l = 0; l < 3; ++l) sum(k, i) += r(j, l) * turns(3 * i + j, 3 * k + l);
  return sum;
}

// Shah's: vec R_base, by columns, is the left vector of the largest singular value of the sum of
// A (x) Q, which is the number of poses where there is no noise.
std::optional<Eigen::Matrix3d> BaseRotation(const PoseMoments& moments) {
  Matrix9d k;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int l = 0; l < 9; ++l)
        k(3 * i + l / 3, 3 * j + l % 3) = moments.turns(3 * i + j, l) / moments.poses;
  const SpdFactor<9> shifted(Matrix9d(kShift * Matrix9d::Identity() - k * k.transpose()));
  Eigen::Matrix<double, 9, 1> u;
  u << 1.0, 0.3, -0.2, 0.5, 0.9, 0.7, -0.4, 0.6, 0.8;  // any
  u.normalize();
  for (int step = 0; step < kMaxInverseSteps; ++step) {
    const Eigen::Matrix<double, 9, 1> next = shifted.Solve(u).normalized();
    const double change = 1.0 - std::abs(next.dot(u));
    u = next;
    if (!(change < kSettled * kSettled)) continue;
    const Eigen::Matrix3d base = Eigen::Map<const Eigen::Matrix3d>(u.data());
    return NearRotation(base.determinant() < 0.0 ? Eigen::Matrix3d(-base) : base);
  }
  return std::nullopt;
}

}  // namespace

std::optional<BaseAndTool> MomentStart::ClosedForm() const {
  const PoseMoments& s = moments_;
  const double n = s.poses;
  const std::optional<Eigen::Matrix3d> base = BaseRotation(s);
  if (!base) return std::nullopt;
  const Eigen::Matrix3d z = base->transpose();
  const std::optional<Eigen::Matrix3d> tool = NearRotation(ToolTurns(s.turns, z));
  if (!tool) return std::nullopt;
  // a + A t = z q - c: least squares for t about the means.
  const Eigen::Matrix3d mean_turn = s.reported / n;
  const Eigen::Vector3d mean_shift = (z * s.q - s.a) / n;
  Eigen::Vector3d right = -s.reported_a / n - mean_turn.transpose() * mean_shift;
  for (int k = 0; k < 3; ++k) right += s.q_reported[k].transpose() * z.col(k) / n;
  const Eigen::Matrix3d normal = Eigen::Matrix3d::Identity() - mean_turn.transpose() * mean_turn;
  if (!(normal.trace() > kSmallestTurn * kSmallestTurn)) return std::nullopt;
  const Eigen::Vector3d t = normal.inverse() * right;
  const Eigen::Vector3d c = mean_shift - mean_turn * t;
  return BaseAndTool{MakePose(*base, s.first_q + *base * (c - s.first_a)), MakePose(*tool, t)};
}

// With m the measured position in frame B, u = a + A t the predicted one and v = m - u, the
// derivative of v by small motions of base and tool is [-1, [m]x, -A r, 0], but for terms with v.
IsotropicSums::Part MomentStart::PositionsAt(const BaseAndTool& mounts) const {
  const PoseMoments& s = moments_;
  const double n = s.poses;
  const Eigen::Matrix3d z = mounts.world_from_base.rotation.toRotationMatrix().transpose();
  const Eigen::Matrix3d r = mounts.platform_from_tool.rotation.toRotationMatrix();
  const Eigen::Vector3d& t = mounts.platform_from_tool.translation;
  const Eigen::Vector3d b = z * (mounts.world_from_base.translation - s.first_q);  // m = z q - b
  const Eigen::Vector3d m = z * s.q - n * b;
  const Eigen::Matrix3d zqb = z * s.q * b.transpose();
  const Eigen::Matrix3d mm =
      z * s.qq * z.transpose() - zqb - zqb.transpose() + n * b * b.transpose();
  Eigen::Matrix3d m_reported[3];                 // m_k A
  Eigen::Vector3d back = -s.reported_a - n * t;  // A' v
  back -= s.reported.transpose() * s.first_a;
  for (int k = 0; k < 3; ++k) {
    m_reported[k] = z(k, 0) * s.q_reported[0] + z(k, 1) * s.q_reported[1] +
                    z(k, 2) * s.q_reported[2] - b[k] * s.reported;
    back += m_reported[k].row(k).transpose();
  }
  const Eigen::Matrix3d m_cross = CrossedRows(m_reported);  // [m]x A
  IsotropicSums::Part part;
  part.weights = n;
  part.normal.block<3, 3>(0, 0) = part.normal.block<3, 3>(6, 6) = n * Eigen::Matrix3d::Identity();
  part.normal.block<3, 3>(0, 3) = -Skew(m);
  part.normal.block<3, 3>(0, 6) = s.reported * r;
  part.normal.block<3, 3>(3, 6) = m_cross * r;
  part.normal.block<3, 3>(3, 3) = mm.trace() * Eigen::Matrix3d::Identity() - mm;
  Mirror(&part.normal);
  const Eigen::Vector3d m_cross_a = -2.0 * SkewPart(z * s.qa - b * s.a.transpose());
  part.gradient.segment<3>(0) = s.a + n * s.first_a + s.reported * t - m;
  part.gradient.segment<3>(3) = m_cross_a + m.cross(s.first_a) + m_cross * t;
  part.gradient.segment<3>(6) = -r.transpose() * back;
  return part;
}

// The error of a rotation is that of the skew part of (A r)' z Q: its axis times its sine.
IsotropicSums::Part MomentStart::OrientationsAt(const BaseAndTool& mounts) const {
  const PoseMoments& s = moments_;
  const Eigen::Matrix3d z = mounts.world_from_base.rotation.toRotationMatrix().transpose();
  const Eigen::Matrix3d r = mounts.platform_from_tool.rotation.toRotationMatrix();
  IsotropicSums::Part part;
  part.weights = s.poses;
  part.normal.block<3, 3>(3, 3) = part.normal.block<3, 3>(9, 9) =
      s.poses * Eigen::Matrix3d::Identity();
  part.normal.block<3, 3>(3, 9) = s.reported * r;
  Mirror(&part.normal);
  part.gradient.segment<3>(3) = -SkewPart(z * BaseTurns(s.turns, r));
  part.gradient.segment<3>(9) = -SkewPart(r.transpose() * ToolTurns(s.turns, z));
  return part;
}

IsotropicSums MomentStart::At(const BaseAndTool& mounts) const {
  return {PositionsAt(mounts), OrientationsAt(mounts), {}};
}

std::optional<double> MomentStart::Minimise(double position,
                                            double orientation,
                                            BaseAndTool* mounts) const {
  double last = std::numeric_limits<double>::infinity(), rate = 0.0;
  for (int k = 0; k < kMaxSteps; ++k) {
    const IsotropicSums parts = At(*mounts);
    const SpdFactor<12> factor(
        Matrix12d(position * parts.position.normal + orientation * parts.orientation.normal));
    if (!(factor.smallest_pivot() > kSafePivot)) return std::nullopt;
    const Vector12d gradient =
        position * parts.position.gradient + orientation * parts.orientation.gradient;
    const Vector12d step = -factor.Solve(gradient);
    const double length = std::sqrt(std::max(0.0, -step.dot(gradient)));
    if (!(length < kShrinks * last)) return std::nullopt;
    *mounts = Moved(*mounts, step);
    rate = std::max(rate, length / last);
    if (length < kLastStep) return rate;
    last = length;
  }
  return std::nullopt;
}

double MomentStart::Misfit(double position_squares, double orientation_squares) const {
  const PoseMoments& s = moments_;
  const double n = s.poses;
  const double position =
      std::max(s.qq.trace() / n - (s.q / n).squaredNorm(), s.aa / n - (s.a / n).squaredNorm());
  const double orientation = 0.5 * (3.0 - (s.measured / n).squaredNorm());
  return position_squares / n / position +
         orientation_squares / n / std::max(orientation, kSmallestTurn * kSmallestTurn);
}

}  // namespace hexcal
