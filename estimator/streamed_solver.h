// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "estimator/nonlinear.h"
#include "residuals/streamed_residual.h"

namespace hexcal {

// The parameter blocks of a streamed residual, [tx ty tz qx qy qz qw] for a pose; base and tool
// first.
using ParameterBlocks = std::vector<Eigen::VectorXd>;

ParameterBlocks BlocksOf(const BaseAndTool& mounts);
BaseAndTool MountsOf(const ParameterBlocks& blocks);
// Every block moved by its part of step: a pose by Plus, else by addition.
ParameterBlocks Moved(const ParameterBlocks& blocks, const Eigen::VectorXd& step);

NormalEquations Evaluate(const StreamedResidual& residual, const ParameterBlocks& blocks);

// Minimises the residual from *blocks, which are replaced by the solution: Levenberg-Marquardt by
// Ceres over the rows of StreamedCost, then Polished. equations: at the solution, but for the last
// step of less than 1e-9 standard deviations.
Solution SolveStreamed(const StreamedResidual& residual,
                       const NonlinearOptions& options,
                       ParameterBlocks* blocks,
                       NormalEquations* equations = nullptr);

// Gauss-Newton steps until the gradient is zero to rounding: a cost that is flat to 1 part in 1e15
// leaves the parameters 1e-8 of a standard deviation apart, which depends on the order of the rows.
// equations: at blocks; at the solution after it, as in SolveStreamed.
ParameterBlocks Polished(const StreamedResidual& residual,
                         ParameterBlocks blocks,
                         NormalEquations* equations);

IterationRecord RecordOf(double cost, const NormalEquations& equations);

}  // namespace hexcal
