// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/closed_form.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <Eigen/SVD>

#include "config/units.h"
#include "geometry/align_points.h"

namespace hexcal {
namespace {

using Rows = std::vector<Observation>;

// Rotation vectors nearer to a half turn than this, rad, have no certain sign.
constexpr double kHalfTurnMargin = 0.2;
// Partners of a pose in relative motions, where all pairs would be too many.
constexpr std::size_t kMaxPartners = 40;
constexpr int kScanSteps = 24;
constexpr double kRankThreshold = 1e-9;

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

// t_i = t_base + R_base (a_i + A_i t_tool): linear in both translations; the shortest solution
// where they cannot be told apart. Solved in the base's axes about the mean, so that the result
// does not depend on where the origins are.
BaseAndTool WithTranslations(const Rows& rows,
                             const Eigen::Matrix3d& base,
                             const Eigen::Matrix3d& tool) {
  Eigen::Matrix<double, 6, 6> normal = Eigen::Matrix<double, 6, 6>::Zero();
  Vector6d right = Vector6d::Zero();
  for (const Observation& o : rows) {
    Eigen::Matrix<double, 3, 6> row;
    row << Eigen::Matrix3d::Identity(), Robot(o);
    const Eigen::Vector3d value =
        base.transpose() * o.world_from_tool.translation - o.base_from_platform.translation;
    normal += row.transpose() * row;
    right += row.transpose() * value;
  }
  Eigen::CompleteOrthogonalDecomposition<Matrix6d> solver;
  solver.setThreshold(kRankThreshold);
  solver.compute(normal);
  const Vector6d x = solver.solve(right);
  return {MakePose(base, base * x.head<3>()), MakePose(tool, x.tail<3>())};
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
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(k, Eigen::ComputeFullU);
  const Eigen::Matrix<double, 9, 1> u = svd.matrixU().col(0);
  const Eigen::Matrix3d base = Eigen::Map<const Eigen::Matrix3d>(u.data());
  return NearestRotation(base.determinant() < 0 ? Eigen::Matrix3d(-base) : base);
}

// Sums over pairs of poses of the relative rotation vectors: alpha in the world, beta in the base,
// alpha = R_base beta.
struct RelativeMotions {
  Eigen::Matrix3d alpha_beta = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d beta_beta = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d alpha_alpha = Eigen::Matrix3d::Zero();
};

RelativeMotions SumRelativeMotions(const Rows& rows) {
  RelativeMotions sums;
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
      if (std::max(alpha.norm(), beta.norm()) > kPi - kHalfTurnMargin) continue;
      sums.alpha_beta += alpha * beta.transpose();
      sums.beta_beta += beta * beta.transpose();
      sums.alpha_alpha += alpha * alpha.transpose();
    }
  return sums;
}

Eigen::Matrix3d BaseByPositions(const Rows& rows) {
  Eigen::Matrix3Xd world(3, rows.size()), base(3, rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    world.col(i) = rows[i].world_from_tool.translation;
    base.col(i) = rows[i].base_from_platform.translation;
  }
  return AlignPoints(world, base).rotation.toRotationMatrix();
}

BaseAndTool WithBase(const Rows& rows, const Eigen::Matrix3d& base) {
  return WithTranslations(rows, base, ToolRotation(rows, base));
}

// What is left, dimensionless: positions in units of their own spread, rotations in rad.
double Misfit(const Rows& rows, const BaseAndTool& mounts) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Observation& o : rows) mean += o.world_from_tool.translation / rows.size();
  double spread = 0.0, position = 0.0, orientation = 0.0;
  for (const Observation& o : rows) {
    spread += (o.world_from_tool.translation - mean).squaredNorm();
    const Vector6d e = PoseError(mounts, o.base_from_platform, o.world_from_tool);
    position += e.head<3>().squaredNorm();
    orientation += e.tail<3>().squaredNorm();
  }
  return orientation / rows.size() + (spread > 0 ? position / spread : 0.0);
}

// All rotations about one axis: the rotations leave R_base free about it, and the positions decide.
std::vector<Eigen::Matrix3d> ScanAboutTheAxis(const RelativeMotions& sums) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> in_base(sums.beta_beta),
      in_world(sums.alpha_alpha);
  const Eigen::Vector3d axis_in_base = in_base.eigenvectors().col(2);
  Eigen::Vector3d axis_in_world = in_world.eigenvectors().col(2);
  if (axis_in_world.dot(sums.alpha_beta * axis_in_base) < 0) axis_in_world = -axis_in_world;
  const Eigen::Quaterniond onto = Eigen::Quaterniond::FromTwoVectors(axis_in_base, axis_in_world);
  std::vector<Eigen::Matrix3d> bases;
  for (int k = 0; k < kScanSteps; ++k)
    bases.push_back(
        (onto * Eigen::AngleAxisd(2 * kPi * k / kScanSteps, axis_in_base)).toRotationMatrix());
  return bases;
}

bool ShareOneAxis(const RelativeMotions& sums) {
  const Eigen::Vector3d spread =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(sums.beta_beta).eigenvalues();
  return spread[1] < 1e-2 * spread[2];
}

}  // namespace

BaseAndTool SolveClosedForm(ClosedForm method, const Rows& rows) {
  return WithBase(rows,
                  method == ClosedForm::kShah
                      ? BaseByShah(rows)
                      : NearestRotation(SumRelativeMotions(rows).alpha_beta));
}

BaseAndTool BestClosedForm(const Rows& rows) {
  const RelativeMotions sums = SumRelativeMotions(rows);
  std::vector<Eigen::Matrix3d> bases = {
      BaseByShah(rows), NearestRotation(sums.alpha_beta), BaseByPositions(rows)};
  if (ShareOneAxis(sums))
    for (const Eigen::Matrix3d& base : ScanAboutTheAxis(sums)) bases.push_back(base);
  BaseAndTool best;
  double least = std::numeric_limits<double>::infinity();
  for (const Eigen::Matrix3d& base : bases) {
    const BaseAndTool mounts = WithBase(rows, base);
    const double misfit = Misfit(rows, mounts);
    if (misfit < least) least = misfit, best = mounts;
  }
  return best;
}

}  // namespace hexcal
