// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/closed_form.h"

#include <Eigen/Eigenvalues>

#include "config/units.h"
#include "estimator/chordal_cost.h"
#include "geometry/align_points.h"
#include "geometry/linear_algebra.h"

namespace hexcal {
namespace {

using Rows = std::vector<Observation>;

// Rotation vectors nearer to a half turn than this, rad, have no certain sign.
constexpr double kHalfTurnMargin = 0.2;
// Partners of a pose in relative motions, where all pairs would be too many.
constexpr std::size_t kMaxPartners = 40;
// Root mean square turn, rad, below which rotations do not tell base and tool apart.
constexpr double kSmallestTurn = 1e-6;
// Pivots of normal equations below this part of the largest are rounding.
constexpr double kSmallestPivot = 1e-14;

Eigen::Matrix3d Robot(const Observation& o) {
  return o.base_from_platform.rotation.toRotationMatrix();
}
Eigen::Matrix3d Tool(const Observation& o) { return o.world_from_tool.rotation.toRotationMatrix(); }

// The tool rotation that fits best on average, the base rotation given.
Eigen::Matrix3d ToolRotation(const Rows& rows, const Eigen::Matrix3d& base) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const Observation& o : rows) sum += Robot(o).transpose() * base.transpose() * Tool(o);
  return NearestRotation(sum);
}

// t_i = t_base + R_base (a_i + A_i t_tool): linear in both translations. Solved about the mean, in
// the base's axes, so that nothing depends on where the origins are; along directions in which the
// rotations do not tell base and tool apart the tool stays at the platform's origin.
BaseAndTool WithTranslations(const Rows& rows,
                             const Eigen::Matrix3d& base,
                             const Eigen::Matrix3d& tool) {
  const double n = static_cast<double>(rows.size());
  const auto shift = [&base](const Observation& o) -> Eigen::Vector3d {
    return base.transpose() * o.world_from_tool.translation - o.base_from_platform.translation;
  };
  Eigen::Matrix3d mean_turn = Eigen::Matrix3d::Zero();
  Eigen::Vector3d mean_shift = Eigen::Vector3d::Zero();
  for (const Observation& o : rows) mean_turn += Robot(o) / n, mean_shift += shift(o) / n;
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (const Observation& o : rows) {
    const Eigen::Matrix3d turn = Robot(o) - mean_turn;
    normal += turn.transpose() * turn / n;
    right += turn.transpose() * (shift(o) - mean_shift) / n;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(normal);
  Eigen::Vector3d tool_shift = Eigen::Vector3d::Zero();
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d direction = eigen.eigenvectors().col(k);
    if (eigen.eigenvalues()[k] > kSmallestTurn * kSmallestTurn)
      tool_shift += direction * direction.dot(right) / eigen.eigenvalues()[k];
  }
  return {MakePose(base, base * (mean_shift - mean_turn * tool_shift)), MakePose(tool, tool_shift)};
}

Eigen::Matrix3d BaseByShah(const Rows& rows) {
  // vec(R_base) ~ sum(A_i (x) Q_i) vec(R_tool'): the largest singular pair, n where there is no
  // noise. Its left vector is the largest eigenvector of K K', found in a fifth of the time.
  Eigen::Matrix<double, 9, 9> k = Eigen::Matrix<double, 9, 9>::Zero();
  for (const Observation& o : rows) {
    const Eigen::Matrix3d a = Robot(o), q = Tool(o);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) k.block<3, 3>(3 * i, 3 * j) += a(i, j) * q;
  }
  const Eigen::VectorXd u = DecomposeSymmetric(k * k.transpose()).vectors.col(8);
  const Eigen::Matrix3d base = Eigen::Map<const Eigen::Matrix3d>(u.data());
  return NearestRotation(base.determinant() < 0 ? Eigen::Matrix3d(-base) : base);
}

// Relative motions of pairs of poses have rotation vectors alpha in the world and beta in the base
// with alpha = R_base beta.
Eigen::Matrix3d BaseByParkMartin(const Rows& rows) {
  Eigen::Matrix3d alpha_beta = Eigen::Matrix3d::Zero();
  const std::size_t n = rows.size();
  const std::size_t partners = std::min(n - 1, kMaxPartners);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 1; k <= partners; ++k) {
      // Spread over the whole set; all pairs (each twice) where the set is small.
      const std::size_t j = (i + k * (n - 1) / partners) % n;
      const Eigen::Vector3d beta = Log(Eigen::Quaterniond(
          rows[i].base_from_platform.rotation * rows[j].base_from_platform.rotation.conjugate()));
      const Eigen::Vector3d alpha = Log(Eigen::Quaterniond(
          rows[i].world_from_tool.rotation * rows[j].world_from_tool.rotation.conjugate()));
      if (std::max(alpha.norm(), beta.norm()) <= kPi - kHalfTurnMargin)
        alpha_beta += alpha * beta.transpose();
    }
  return NearestRotation(alpha_beta);
}

Eigen::Matrix3d BaseByPositions(const Rows& rows) {
  Eigen::Matrix3Xd world(3, rows.size()), base(3, rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    world.col(i) = rows[i].world_from_tool.translation;
    base.col(i) = rows[i].base_from_platform.translation;
  }
  return AlignPoints(world, base).rotation.toRotationMatrix();
}

// All 24 entries of v in one least-squares problem with equal weights (1 m against 1), then the
// rotations nearest to what comes out. As published, the translations stay as solved.
BaseAndTool SolveLi(const Rows& rows) {
  ChordalCost cost;
  for (const Observation& o : rows) cost.Add(o, 1.0, 2.0);
  constexpr int kFree = ChordalCost::kSize - 1;
  const Eigen::MatrixXd form = cost.Form();
  const Eigen::VectorXd v = ShortestSolution(
      form.topLeftCorner(kFree, kFree), -form.topRightCorner(kFree, 1), kSmallestPivot);
  const Eigen::Matrix3d z = Eigen::Map<const Eigen::Matrix3d>(v.data());
  const Eigen::Matrix3d tool = Eigen::Map<const Eigen::Matrix3d>(v.data() + 9);
  const Eigen::Matrix3d base = NearestRotation(z).transpose();
  return {MakePose(base, base * cost.BaseShift(z, v.segment<3>(21))),
          MakePose(NearestRotation(tool), v.segment<3>(18))};
}

// Of +-q and +-a: the measured quaternion whose turn from the first pose has the scalar part that
// the reported one has. Both turns are one motion, seen from the world and from the base.
Eigen::Quaterniond SameSheet(const Observation& o, const Observation& first) {
  const double reported =
      (o.base_from_platform.rotation * first.base_from_platform.rotation.conjugate()).w();
  const double measured =
      (o.world_from_tool.rotation * first.world_from_tool.rotation.conjugate()).w();
  Eigen::Quaterniond q = o.world_from_tool.rotation;
  if (reported * measured < 0) q.coeffs() = -q.coeffs();
  return q;
}

// a x = y q with quaternions (scalar a0, vector a) of pose, tool, base_from_world and measurement.
// Its scalar row gives x0 and with it three rows for the vectors of x and y, over y0: here times
// a0, so that poses of a half turn have no weight in place of an infinite one.
BaseAndTool SolveZhuang(const Rows& rows) {
  Eigen::Matrix<double, 6, 6> normal = Eigen::Matrix<double, 6, 6>::Zero();
  Eigen::Matrix<double, 6, 1> right = Eigen::Matrix<double, 6, 1>::Zero();
  const Eigen::Matrix3d identity = Eigen::Matrix3d::Identity();
  for (const Observation& o : rows) {
    const Eigen::Quaterniond measured = SameSheet(o, rows[0]);
    const double a0 = o.base_from_platform.rotation.w(), q0 = measured.w();
    const Eigen::Vector3d a = o.base_from_platform.rotation.vec(), q = measured.vec();
    Eigen::Matrix<double, 3, 6> equations;
    equations << a0 * (a0 * identity + Skew(a)) + a * a.transpose(),
        a0 * (Skew(q) - q0 * identity) - a * q.transpose();
    normal += equations.transpose() * equations;
    right += equations.transpose() * (a0 * q - q0 * a);
  }
  const Eigen::VectorXd over_y0 = ShortestSolution(normal, right, kSmallestPivot);
  const Eigen::Vector3d x = over_y0.head<3>(), y = over_y0.tail<3>();
  // The scalar rows, a0 x0 = q0 - y q + x a over y0.
  double numerator = 0.0, denominator = 0.0;
  for (const Observation& o : rows) {
    const Eigen::Quaterniond measured = SameSheet(o, rows[0]);
    const double a0 = o.base_from_platform.rotation.w();
    numerator +=
        a0 * (measured.w() - y.dot(measured.vec()) + x.dot(o.base_from_platform.rotation.vec()));
    denominator += a0 * a0;
  }
  const Eigen::Quaterniond tool(numerator / denominator, x.x(), x.y(), x.z());
  const Eigen::Quaterniond base(1.0, -y.x(), -y.y(), -y.z());
  return WithTranslations(
      rows, base.normalized().toRotationMatrix(), tool.normalized().toRotationMatrix());
}

}  // namespace

BaseAndTool CompleteBase(const Rows& rows, const Eigen::Matrix3d& base_rotation) {
  return WithTranslations(rows, base_rotation, ToolRotation(rows, base_rotation));
}

BaseAndTool SolveClosedForm(ClosedForm method, const Rows& rows) {
  switch (method) {
    case ClosedForm::kShah:
      return CompleteBase(rows, BaseByShah(rows));
    case ClosedForm::kParkMartin:
      return CompleteBase(rows, BaseByParkMartin(rows));
    case ClosedForm::kLi:
      return SolveLi(rows);
    case ClosedForm::kZhuang:
      return SolveZhuang(rows);
    case ClosedForm::kPositions:
      return CompleteBase(rows, BaseByPositions(rows));
  }
  return {};
}

}  // namespace hexcal
