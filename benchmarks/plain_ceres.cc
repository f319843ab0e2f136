// SPDX-License-Identifier: BSD-3-Clause
#include <ceres/ceres.h>
#include <glog/logging.h>

#include "methods.h"
#include "residuals/whitener.h"

namespace hexcal {
namespace {

// Difference of predicted and measured tool pose, weighted by the measurement's noise.
struct PoseDifference {
  Pose3d base_from_platform, world_from_tool;
  Matrix6d root_information;

  template <typename T>
  bool operator()(
      const T* base_t, const T* base_q, const T* tool_t, const T* tool_q, T* residual) const {
    using Vector = Eigen::Matrix<T, 3, 1>;
    using Quaternion = Eigen::Quaternion<T>;
    const Eigen::Map<const Vector> t_base(base_t), t_tool(tool_t);
    const Eigen::Map<const Quaternion> q_base(base_q), q_tool(tool_q);
    const Quaternion q_platform = base_from_platform.rotation.cast<T>();
    const Vector t_platform = base_from_platform.translation.cast<T>();
    const Quaternion q_measured = world_from_tool.rotation.cast<T>();
    const Quaternion q = q_base * q_platform * q_tool;
    const Vector t = t_base + q_base * (t_platform + q_platform * t_tool);
    Eigen::Matrix<T, 6, 1> e;
    e.template head<3>() =
        q_measured.conjugate() * Vector(t - world_from_tool.translation.cast<T>());
    e.template tail<3>() = T(2.0) * (q_measured.conjugate() * q).vec();
    Eigen::Map<Eigen::Matrix<T, 6, 1>>{residual} = root_information.cast<T>() * e;
    return true;
  }
};

struct Blocks {
  explicit Blocks(const Pose3d& pose) : t(pose.translation), q(pose.rotation) {}
  Eigen::Vector3d t;
  Eigen::Quaterniond q;
};

BaseAndTool SolvePlainly(const Observations& observations, const BaseAndTool& start) {
  Blocks base(start.world_from_base), tool(start.platform_from_tool);
  ceres::Problem problem;
  for (const Observation& o : observations.items)
    problem.AddResidualBlock(
        new ceres::AutoDiffCostFunction<PoseDifference, 6, 3, 4, 3, 4>(new PoseDifference{
            o.base_from_platform, o.world_from_tool, WhitenerOf(o.tool_covariance)}),
        nullptr,
        base.t.data(),
        base.q.coeffs().data(),
        tool.t.data(),
        tool.q.coeffs().data());
  problem.SetManifold(base.q.coeffs().data(), new ceres::EigenQuaternionManifold);
  problem.SetManifold(tool.q.coeffs().data(), new ceres::EigenQuaternionManifold);

  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  CHECK(summary.IsSolutionUsable()) << summary.message;

  ceres::Covariance covariance(ceres::Covariance::Options{});
  const std::vector<const double*> blocks = {
      base.t.data(), base.q.coeffs().data(), tool.t.data(), tool.q.coeffs().data()};
  CHECK(covariance.Compute(blocks, &problem));
  Eigen::Matrix<double, 12, 12, Eigen::RowMajor> c;
  CHECK(covariance.GetCovarianceMatrixInTangentSpace(blocks, c.data()));
  CHECK(c.allFinite());
  return {{base.t, base.q}, {tool.t, tool.q}};
}

}  // namespace

Method PlainCeres() {
  return {
      "plain Ceres", [](const Observations& observations, const BaseAndTool& truth) {
        const Vector6d away = Vector6d::Constant(0.1);
        const BaseAndTool start{Plus(truth.world_from_base, away),
                                Plus(truth.platform_from_tool, away)};
        return Calibration([&observations, start] { return SolvePlainly(observations, start); });
      }};
}

}  // namespace hexcal
