// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/tiny.h"

#include <ceres/tiny_solver.h>

#include <cmath>

#include "residuals/streamed_cost.h"

namespace hexcal {
namespace {

// The right Jacobian of Exp: Exp(v + d) = Exp(v) Exp(RightJacobian(v) d) to first order. It is the
// inverse of the transposed inverse left one.
Eigen::Matrix3d RightJacobian(const Eigen::Vector3d& v) {
  return LeftJacobianInverse(v).transpose().inverse();
}

// The rows of a streamed residual over the 12 small motions away from a point.
class LocalRows {
 public:
  using Scalar = double;
  enum { NUM_RESIDUALS = 13, NUM_PARAMETERS = 12 };

  LocalRows(const StreamedResidual& residual,
            const ParameterBlocks& origin,
            std::vector<IterationRecord>* records)
      : residual_(residual), origin_(origin), records_(records) {}

  // One pass a point.
  const NormalEquations& At(const Vector12d& d) const {
    if (d != point_ || equations_.poses == 0) {
      equations_ = Evaluate(residual_, Moved(origin_, d));
      point_ = d;
    }
    return equations_;
  }

  bool operator()(const double* motion, double* residuals, double* jacobian) const {
    const Vector12d d = Eigen::Map<const Vector12d>(motion);
    Eigen::Map<Eigen::Matrix<double, 13, 1>> r(residuals);
    At(d);
    if (jacobian == nullptr) {
      r.setZero();
      r[0] = std::sqrt(equations_.squared_norm);
      return std::isfinite(r[0]);
    }
    const WhitenedRows rows = RowsOf(equations_);
    r = rows.residual;
    Eigen::Map<Eigen::Matrix<double, 13, 12>> j(jacobian);
    for (int b = 0; b < 12; b += 6) {
      const Eigen::Vector3d turn = d.segment<3>(b + 3);
      j.middleCols<3>(b) =
          rows.jacobian.middleCols<3>(b) * Exp(turn).toRotationMatrix().transpose();
      j.middleCols<3>(b + 3) = rows.jacobian.middleCols<3>(b + 3) * RightJacobian(turn);
    }
    records_->push_back(RecordOf(0.5 * equations_.squared_norm, equations_));
    return j.allFinite() && r.allFinite();
  }

 private:
  const StreamedResidual& residual_;
  const ParameterBlocks& origin_;
  std::vector<IterationRecord>* records_;
  mutable Vector12d point_ = Vector12d::Zero();
  mutable NormalEquations equations_;
};

}  // namespace

Solution SolveTiny(const StreamedResidual& residual,
                   const NonlinearOptions& options,
                   ParameterBlocks* blocks,
                   NormalEquations* equations) {
  Solution solution;
  const ParameterBlocks origin = *blocks;
  ceres::TinySolver<LocalRows> solver;
  solver.options.max_num_iterations = options.max_iterations;
  // Squared whitened errors: a change of 1e-6 is a thousandth of a standard deviation, from where
  // the refinement converges at once.
  solver.options.function_tolerance = 1e-6;
  solver.options.parameter_tolerance = options.tolerance;
  solver.options.gradient_tolerance = 0.0;
  solver.options.cost_threshold = 0.0;
  Vector12d motion = Vector12d::Zero();
  const LocalRows rows(residual, origin, &solution.iterations);
  solver.Solve(rows, &motion);
  using Status = ceres::TinySolver<LocalRows>::Status;
  solution.converged = solver.summary.status != Status::HIT_MAX_ITERATIONS && motion.allFinite();
  if (solution.converged) {
    *blocks = Moved(origin, motion);
    *equations = rows.At(motion);
    *blocks = Polished(residual, *blocks, equations);
  } else {
    solution.message = "the small solver did not converge within its iterations";
  }
  solution.mounts = MountsOf(*blocks);
  return solution;
}

}  // namespace hexcal
