// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/streamed_solver.h"

#include <ceres/problem.h>
#include <ceres/solver.h>
#include <glog/logging.h>

#include <cmath>
#include <limits>

#include "estimator/ceres_options.h"
#include "estimator/normal_matrix.h"
#include "residuals/pose_manifold.h"
#include "residuals/streamed_cost.h"

namespace hexcal {
namespace {

// Of the cost: where weights are steep, its rounding keeps Ceres from seeing that it has converged.
constexpr double kNothing = 1e-9;
constexpr int kMaxPolishSteps = 10;
// A step of this many standard deviations needs no other after it.
constexpr double kLastStep = 1e-9;

std::vector<const double*> Pointers(const ParameterBlocks& blocks) {
  std::vector<const double*> pointers;
  for (const Eigen::VectorXd& block : blocks) pointers.push_back(block.data());
  return pointers;
}

// Writes down every accepted or refused step.
class Recorder : public ceres::IterationCallback {
 public:
  Recorder(const StreamedCost& cost,
           const ParameterBlocks& blocks,
           const NonlinearOptions& options,
           std::vector<IterationRecord>* records)
      : cost_(cost), blocks_(blocks), options_(options), records_(records) {}

  ceres::CallbackReturnType operator()(const ceres::IterationSummary& summary) override {
    // A refused step is the only case in which the point of the last evaluation is another.
    if (summary.step_is_successful || records_->empty())
      records_->push_back(RecordOf(summary.cost, cost_.At(Pointers(blocks_).data())));
    else
      records_->push_back(records_->back());
    if (options_.after_iteration)
      options_.after_iteration(summary.iteration, options_.max_iterations);
    return ceres::SOLVER_CONTINUE;
  }

 private:
  const StreamedCost& cost_;
  const ParameterBlocks& blocks_;
  const NonlinearOptions& options_;
  std::vector<IterationRecord>* records_;
};

// How many standard deviations a step is long, all parameters together.
double LengthInSigmas(const NormalEquations& equations, const Eigen::VectorXd& step) {
  return std::sqrt(std::max(0.0, -step.dot(equations.gradient)));
}

}  // namespace

ParameterBlocks BlocksOf(const BaseAndTool& mounts) {
  ParameterBlocks blocks(2, Eigen::VectorXd(Pose3d::kNumParameters));
  mounts.world_from_base.ToParameters(blocks[0].data());
  mounts.platform_from_tool.ToParameters(blocks[1].data());
  return blocks;
}

BaseAndTool MountsOf(const ParameterBlocks& blocks) {
  return {Pose3d::FromParameters(blocks[0].data()), Pose3d::FromParameters(blocks[1].data())};
}

ParameterBlocks Moved(const ParameterBlocks& blocks, const Eigen::VectorXd& step) {
  ParameterBlocks moved = blocks;
  Eigen::Index first = 0;
  for (Eigen::VectorXd& block : moved) {
    const int dof = BlockDof(static_cast<int>(block.size()));
    const Eigen::VectorXd part = step.segment(first, dof);
    first += dof;
    if (dof == block.size())
      block += part;
    else
      Plus(Pose3d::FromParameters(block.data()), Vector6d(part)).ToParameters(block.data());
  }
  return moved;
}

NormalEquations Evaluate(const StreamedResidual& residual, const ParameterBlocks& blocks) {
  return residual.Evaluate(Pointers(blocks).data());
}

IterationRecord RecordOf(double cost, const NormalEquations& equations) {
  const double n = static_cast<double>(equations.poses);
  return {cost,
          std::sqrt(equations.position_squares / n),
          std::sqrt(equations.orientation_squares / n)};
}

ParameterBlocks Polished(const StreamedResidual& residual,
                         ParameterBlocks blocks,
                         NormalEquations* equations) {
  double last = std::numeric_limits<double>::infinity();
  for (int k = 0; k < kMaxPolishSteps; ++k) {
    const Eigen::VectorXd step = GaussNewtonStep(*equations);
    const double size = step.cwiseAbs().maxCoeff();
    if (!(size < 0.5 * last)) break;  // rounding is all that is left
    blocks = Moved(blocks, step);
    if (LengthInSigmas(*equations, step) < kLastStep) break;
    *equations = Evaluate(residual, blocks);
    last = size;
  }
  return blocks;
}

Solution SolveStreamed(const StreamedResidual& residual,
                       const NonlinearOptions& options,
                       ParameterBlocks* blocks,
                       NormalEquations* equations) {
  NormalEquations own;
  if (equations == nullptr) equations = &own;
  Solution solution;
  solution.mounts = MountsOf(*blocks);
  StreamedCost cost(residual);
  *equations = cost.At(Pointers(*blocks).data());
  if (!std::isfinite(equations->squared_norm) || !equations->normal.allFinite()) {
    solution.message = "the weighted errors at the start are beyond the range of numbers";
    solution.iterations.emplace_back();
    return solution;
  }
  PoseManifold manifold;
  ceres::Problem::Options problem_options;
  problem_options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  problem_options.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem problem(problem_options);
  std::vector<double*> pointers;
  for (Eigen::VectorXd& block : *blocks) {
    const int size = static_cast<int>(block.size());
    problem.AddParameterBlock(
        block.data(), size, size == Pose3d::kNumParameters ? &manifold : nullptr);
    pointers.push_back(block.data());
  }
  problem.AddResidualBlock(&cost, nullptr, pointers);

  Recorder recorder(cost, *blocks, options, &solution.iterations);
  ceres::Solver::Options solver_options = CeresOptions(options);
  solver_options.callbacks.push_back(&recorder);
  ceres::Solver::Summary summary;
  ceres::Solve(solver_options, &problem, &summary);
  solution.converged = summary.termination_type == ceres::CONVERGENCE;
  *equations = cost.At(Pointers(*blocks).data());
  if (!solution.converged) {
    const double length = LengthInSigmas(*equations, GaussNewtonStep(*equations));
    solution.converged = 0.5 * length * length < kNothing * summary.final_cost;
  }
  if (solution.converged)
    *blocks = Polished(residual, *blocks, equations);
  else
    solution.message = summary.message;
  solution.mounts = MountsOf(*blocks);
  return solution;
}

}  // namespace hexcal
