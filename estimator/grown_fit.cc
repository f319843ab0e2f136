// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/grown_fit.h"

#include <ceres/ceres.h>

#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "geometry/linear_algebra.h"
#include "residuals/pose_manifold.h"

namespace hexcal {
namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// A share in a null direction below this is rounding.
constexpr double kNoShare = 1e-3;

Mounts MountsOf(const double* base, const double* tool) {
  return {Pose3d::FromParameters(base), Pose3d::FromParameters(tool)};
}

// All residuals at once: they share every parameter.
class GrownCost final : public ceres::CostFunction {
 public:
  explicit GrownCost(const GrownProblem& problem) : problem_(problem) {
    set_num_residuals(problem.num_rows());
    mutable_parameter_block_sizes()->assign(2, Pose3d::kNumParameters);
    if (problem.num_free() > 0) mutable_parameter_block_sizes()->push_back(problem.num_free());
  }

  bool Evaluate(double const* const* parameters,
                double* residuals,
                double** jacobians) const override {
    const int size = problem_.num_free();
    Eigen::VectorXd free(size);
    if (size > 0) free = Eigen::Map<const Eigen::VectorXd>(parameters[2], size);
    const auto evaluation =
        problem_.Evaluate(MountsOf(parameters[0], parameters[1]), free, jacobians != nullptr);
    if (!evaluation) return false;
    Eigen::Map<Eigen::VectorXd>(residuals, num_residuals()) = evaluation->residual;
    if (jacobians == nullptr) return true;
    for (const int mount : {0, 1}) {
      if (jacobians[mount] == nullptr) continue;
      Eigen::Matrix<double, 6, 7, Eigen::RowMajor> tangent;
      manifold_.MinusJacobian(parameters[mount], tangent.data());
      Eigen::Map<RowMajor>(jacobians[mount], num_residuals(), 7) =
          evaluation->jacobian.middleCols<6>(6 * mount) * tangent;
    }
    if (size > 0 && jacobians[2] != nullptr)
      Eigen::Map<RowMajor>(jacobians[2], num_residuals(), size) =
          evaluation->jacobian.rightCols(size);
    return true;
  }

 private:
  const GrownProblem& problem_;
  PoseManifold manifold_;
};

struct Solved {
  Mounts mounts;
  Eigen::VectorXd free;
  double cost = std::numeric_limits<double>::infinity();
  bool converged = false;
  std::string message;
};

ceres::Solver::Options SolverOptions(const GrownFitOptions& options) {
  ceres::Solver::Options solver;
  solver.linear_solver_type = ceres::DENSE_QR;
  solver.max_num_iterations = options.max_iterations;
  solver.function_tolerance = options.function_tolerance;
  solver.parameter_tolerance = 1e-16;  // parameters have units: 1e-11 m is not small for a screw
  solver.gradient_tolerance = 0.0;
  solver.num_threads = 1;
  solver.logging_type = ceres::SILENT;
  return solver;
}

Solved SolveFrom(const GrownProblem& problem,
                 const Mounts& mounts,
                 const Eigen::VectorXd& start,
                 const GrownFitOptions& options) {
  Solved solved;
  solved.mounts = mounts;
  solved.free = start;
  // Ceres complains at length on stderr of a start that it cannot evaluate.
  if (!problem.Evaluate(mounts, start, true)) {
    solved.message = "the start puts legs out of reach, or readings beyond the range of numbers";
    return solved;
  }
  double base[Pose3d::kNumParameters], tool[Pose3d::kNumParameters];
  mounts.world_from_base.ToParameters(base);
  mounts.platform_from_tool.ToParameters(tool);
  PoseManifold manifold;
  ceres::Problem::Options problem_options;
  problem_options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem ceres_problem(problem_options);
  std::vector<double*> blocks = {base, tool};
  if (solved.free.size() > 0) blocks.push_back(solved.free.data());
  ceres_problem.AddResidualBlock(new GrownCost(problem), nullptr, blocks);
  ceres_problem.SetManifold(base, &manifold);
  ceres_problem.SetManifold(tool, &manifold);
  ceres::Solver::Summary summary;
  ceres::Solve(SolverOptions(options), &ceres_problem, &summary);
  solved.mounts = MountsOf(base, tool);
  solved.cost = summary.final_cost;
  solved.converged = summary.termination_type == ceres::CONVERGENCE;
  if (!solved.converged) solved.message = summary.message;
  return solved;
}

// (J' J)^-1 within the directions that J determines.
void SetCovariance(const Eigen::MatrixXd& jacobian, double smallest_ratio, GrownFit* fit) {
  const Eigen::Index size = jacobian.cols();
  const Eigen::VectorXd norms =
      jacobian.colwise().norm().unaryExpr([](double norm) { return norm > 0.0 ? norm : 1.0; });
  const Eigen::MatrixXd scaled = jacobian * norms.cwiseInverse().asDiagonal();
  const SingularValues svd = Decompose(scaled.rows() >= size ? TriangularFactor(scaled) : scaled);
  const double least = smallest_ratio * svd.singular_values[0];
  fit->covariance.setZero(size, size);
  fit->determined.assign(size, true);
  for (Eigen::Index k = 0; k < size; ++k) {
    const Eigen::VectorXd direction = svd.v.col(k).cwiseQuotient(norms);
    if (k < svd.singular_values.size() && svd.singular_values[k] > least) {
      const Eigen::VectorXd sigma = direction / svd.singular_values[k];
      fit->covariance += sigma * sigma.transpose();
      continue;
    }
    for (Eigen::Index i = 0; i < size; ++i)
      if (std::abs(svd.v(i, k)) > kNoShare) fit->determined[i] = false;
  }
}

void SetStandardDeviations(const GrownProblem& problem, GrownFit* fit) {
  for (Effect& effect : fit->effects)
    effect.standard_deviation = Eigen::VectorXd::Constant(effect.parameters.size(),
                                                          std::numeric_limits<double>::quiet_NaN());
  Eigen::Index at = 12;
  for (const auto& [effect, number] : problem.FreeNumbers()) {
    if (fit->determined[at])
      fit->effects[effect].standard_deviation[number] = std::sqrt(fit->covariance(at, at));
    ++at;
  }
}

GrownFit Finish(const GrownProblem& problem, const Solved& best, const GrownFitOptions& options) {
  GrownFit fit;
  fit.mounts = best.mounts;
  fit.free = best.free;
  fit.effects = problem.EffectsAt(best.free);
  fit.converged = best.converged;
  fit.message = best.message;
  auto evaluation = problem.Evaluate(best.mounts, best.free, true);
  if (!evaluation) return fit;
  SetCovariance(evaluation->jacobian, options.smallest_ratio, &fit);
  SetStandardDeviations(problem, &fit);
  const auto pose_rows = 6 * static_cast<Eigen::Index>(problem.data().poses.size());
  const Eigen::Index misfit_rows = problem.num_misfit();
  const Eigen::VectorXd& residual = evaluation->residual;
  fit.chi_square = residual.head(pose_rows).squaredNorm();
  fit.misfit_chi_square = residual.segment(pose_rows, misfit_rows).squaredNorm();
  fit.prior_chi_square = residual.tail(residual.size() - pose_rows - misfit_rows).squaredNorm();
  fit.errors = std::move(evaluation->errors);
  fit.predicted = std::move(evaluation->predicted);
  fit.seen = std::move(evaluation->seen);
  return fit;
}

}  // namespace

GrownFit FitGrown(const GrownProblem& problem,
                  const Mounts& mounts,
                  const std::vector<Eigen::VectorXd>& starts,
                  const GrownFitOptions& options) {
  const std::vector<Eigen::VectorXd> own = {problem.Start()};
  const std::vector<Eigen::VectorXd>& all = starts.empty() ? own : starts;
  Solved best;
  int best_start = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    Solved solved = SolveFrom(problem, mounts, all[i], options);
    if (i > 0 && !(solved.cost < best.cost)) continue;
    best = std::move(solved);
    best_start = static_cast<int>(i);
  }
  GrownFit fit = Finish(problem, best, options);
  fit.start = best_start;
  return fit;
}

}  // namespace hexcal
