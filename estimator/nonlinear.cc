// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/nonlinear.h"

#include <ceres/ceres.h>
#include <glog/logging.h>

#include <memory>

#include "estimator/ceres_options.h"
#include "estimator/polish.h"
#include "estimator/rms.h"
#include "residuals/pose_manifold.h"
#include "residuals/pose_residual.h"

namespace hexcal {
namespace {

// Of the cost: where weights are steep, its rounding keeps Ceres from seeing that it has converged.
constexpr double kNothing = 1e-9;

// Writes down the RMS errors of every accepted or refused step.
class Recorder : public ceres::IterationCallback {
 public:
  Recorder(const std::vector<Observation>& observations,
           const double* base,
           const double* tool,
           const NonlinearOptions& options,
           std::vector<IterationRecord>* records)
      : observations_(observations),
        base_(base),
        tool_(tool),
        options_(options),
        records_(records) {}

  ceres::CallbackReturnType operator()(const ceres::IterationSummary& summary) override {
    const BaseAndTool mounts{Pose3d::FromParameters(base_), Pose3d::FromParameters(tool_)};
    RmsError rms;
    for (const Observation& o : observations_)
      rms.Add(PoseError(mounts, o.base_from_platform, o.world_from_tool));
    records_->push_back({summary.cost, rms.Position(), rms.Orientation()});
    if (options_.after_iteration)
      options_.after_iteration(summary.iteration, options_.max_iterations);
    return ceres::SOLVER_CONTINUE;
  }

 private:
  const std::vector<Observation>& observations_;
  const double* base_;
  const double* tool_;
  const NonlinearOptions& options_;
  std::vector<IterationRecord>* records_;
};

// Ceres complains at length on stderr of what is not.
bool IsFinite(const std::vector<Observation>& observations,
              const std::vector<Matrix6d>& whiteners,
              const BaseAndTool& mounts) {
  for (std::size_t i = 0; i < observations.size(); ++i) {
    const Observation& o = observations[i];
    const Vector6d e = PoseError(mounts, o.base_from_platform, o.world_from_tool);
    if (!std::isfinite((whiteners[i] * e).squaredNorm())) return false;
  }
  return true;
}

}  // namespace

Solution SolveNonlinear(const std::vector<Observation>& observations,
                        const std::vector<Matrix6d>& whiteners,
                        const BaseAndTool& start,
                        const NonlinearOptions& options,
                        const RobustLoss& loss) {
  CHECK_EQ(observations.size(), whiteners.size());
  Solution solution;
  if (!IsFinite(observations, whiteners, start)) {
    solution.mounts = start;
    solution.message = "the weighted errors at the start are beyond the range of numbers";
    solution.iterations.emplace_back();
    return solution;
  }
  double base[Pose3d::kNumParameters], tool[Pose3d::kNumParameters];
  start.world_from_base.ToParameters(base);
  start.platform_from_tool.ToParameters(tool);
  PoseManifold manifold;
  ceres::Problem::Options problem_options;
  problem_options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  problem_options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  const std::unique_ptr<ceres::LossFunction> ceres_loss = CeresLoss(loss);
  ceres::Problem problem(problem_options);
  problem.AddParameterBlock(base, Pose3d::kNumParameters, &manifold);
  problem.AddParameterBlock(tool, Pose3d::kNumParameters, &manifold);
  for (std::size_t i = 0; i < observations.size(); ++i)
    problem.AddResidualBlock(
        PoseResidual::Create(
            observations[i].base_from_platform, observations[i].world_from_tool, whiteners[i]),
        ceres_loss.get(),
        base,
        tool);

  Recorder recorder(observations, base, tool, options, &solution.iterations);
  ceres::Solver::Options solver_options = CeresOptions(options);
  solver_options.callbacks.push_back(&recorder);
  ceres::Solver::Summary summary;
  ceres::Solve(solver_options, &problem, &summary);
  solution.mounts = {Pose3d::FromParameters(base), Pose3d::FromParameters(tool)};
  solution.converged =
      summary.termination_type == ceres::CONVERGENCE ||
      StepFrom(
          observations, Weighted(observations, whiteners, solution.mounts, loss), solution.mounts)
              .decrease < kNothing * summary.final_cost;
  if (!solution.converged) solution.message = summary.message;
  if (solution.converged) solution.mounts = Polish(observations, whiteners, solution.mounts, loss);
  return solution;
}

}  // namespace hexcal
