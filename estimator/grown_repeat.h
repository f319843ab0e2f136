// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "estimator/grown_target.h"
#include "estimator/monte_carlo.h"

namespace hexcal {

// A joint fit of base, tool and effects repeated: the machine as it was found is measured again
// with the noise of every pose and of the markers' misfit, and fitted again, exactly. Priors count
// as measurements and are drawn as such; the covariance does the same. The common error of a
// tracker that stood still is drawn with each.
// estimate: of the same fit, converged.
PropagationCheck CheckGrownPropagation(const GrownSolution& solution,
                                       const Estimate& estimate,
                                       const MonteCarloOptions& options);

}  // namespace hexcal
