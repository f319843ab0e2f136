// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/ceres_options.h"

namespace hexcal {

ceres::Solver::Options CeresOptions(const NonlinearOptions& options) {
  ceres::Solver::Options solver;
  solver.linear_solver_type = ceres::DENSE_QR;
  solver.max_num_iterations = options.max_iterations;
  solver.function_tolerance = options.tolerance;
  solver.parameter_tolerance = options.tolerance;
  // The gradient has no scale of its own here: weights may be anything from 1 to 1e32.
  solver.gradient_tolerance = 0.0;
  // At a perfect fit rounding makes steps look invalid: let the trust region shrink to its end
  // instead of giving up.
  solver.max_num_consecutive_invalid_steps = 100;
  // The order of sums, and with it every bit of the result, must not depend on the machine.
  solver.num_threads = 1;
  solver.update_state_every_iteration = true;
  solver.logging_type = ceres::SILENT;
  return solver;
}

}  // namespace hexcal
