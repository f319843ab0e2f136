// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/closed_form.h"

#include <Eigen/Eigenvalues>

#include "config/units.h"
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
  // noise.
  Eigen::Matrix<double, 9, 9> k = Eigen::Matrix<double, 9, 9>::Zero();
  for (const Observation& o : rows) {
    const Eigen::Matrix3d a = Robot(o), q = Tool(o);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) k.block<3, 3>(3 * i, 3 * j) += a(i, j) * q;
  }
  const Eigen::VectorXd u = Decompose(k).u.col(0);
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
    case ClosedForm::kPositions:
      return CompleteBase(rows, BaseByPositions(rows));
  }
  return {};
}

}  // namespace hexcal
