// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>

#include "estimator/marker_observations.h"
#include "estimator/streamed_solver.h"
#include "residuals/marker_batch.h"

namespace hexcal {

// What the likelihood is made of there; equations: of that point.
MarkerFit FitOf(const MarkerBatch& batch,
                const ParameterBlocks& blocks,
                const NormalEquations& equations);

// By what factor sigma would have to be multiplied for the restricted likelihood of the readings to
// be largest, everything else as it is (one variance component; Harville, J. Am. Stat. Assoc. 72
// (1977): what is left over against the degrees of freedom that the parameters and the robot's
// draws leave). 1: sigma is the REML estimate.
double RemlFactor(const MarkerObservations& markers, const MarkerFit& fit);

// No sigma means anything below this: rounding of the readings, m.
double SmallestSigma(const MarkerObservations& markers);

struct MarkerSolverOptions {
  NonlinearOptions nonlinear;
  // By SolveMarkerReference in place of MarkerBatch: the same solution, of whose iterations the
  // start and the end are recorded.
  bool by_reference = false;
  int threads = 1;  // the result does not depend on it
};

struct MarkerSolution {
  Solution solution;
  ParameterBlocks blocks;
  Eigen::Vector3d sigma;
  bool sigma_estimated = false;
  // What the fit leaves over against what repeated frames tell, where those set the ratios of the
  // axes' sigmas.
  std::optional<double> over_repeats;
};

// Base, tool and what else is common to the readings, from these mounts on. A sigma that is not
// stated is estimated with them: its ratios between the axes from repeated frames where there are
// enough of them, else equal; its level by REML.
MarkerSolution SolveMarkers(const MarkerObservations& markers,
                            const BaseAndTool& start,
                            const MarkerSolverOptions& options);

}  // namespace hexcal
