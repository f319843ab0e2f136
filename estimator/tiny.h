// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "estimator/streamed_solver.h"

namespace hexcal {

// SolveStreamed for base and tool alone by Ceres's TinySolver: the same solution with less around
// it, for small problems that are solved by the thousand. equations: at the solution.
Solution SolveTiny(const StreamedResidual& residual,
                   const NonlinearOptions& options,
                   ParameterBlocks* blocks,
                   NormalEquations* equations);

}  // namespace hexcal
