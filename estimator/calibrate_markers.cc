// SPDX-License-Identifier: BSD-3-Clause
#include "estimator/calibrate_markers.h"

#include <glog/logging.h>

#include <utility>

#include "estimator/judge_markers.h"
#include "estimator/marker_solver.h"

namespace hexcal {

Estimate CalibrateMarkers(const Observations& observations,
                          const MarkerObservations& markers,
                          const std::optional<BaseAndTool>& initial,
                          const CalibrateOptions& options) {
  CHECK(options.solver == Solver::kNonlinear) << "the linearized iteration knows no markers";
  CalibrateOptions by_poses = options;
  // A start needs no noise level: positions and orientations count by how far they spread.
  by_poses.noise.reset();
  if (!observations.tool_noise_is_known) by_poses.noise = Spread(observations.items);
  const Estimate start = Calibrate(observations, initial, by_poses);
  NonlinearOptions nonlinear = options.nonlinear;
  if (!start.converged) nonlinear.max_iterations = 0;  // there is nothing to refine
  const MarkerSolution solution = SolveMarkers(markers, start.mounts, nonlinear);

  Estimate estimate;
  estimate.warnings = observations.warnings;
  if (options.noise)
    estimate.warnings.push_back(
        "the noise that was given is of measured poses; a calibration by markers does not use it");
  estimate.mounts = solution.solution.mounts;
  estimate.converged = start.converged && solution.solution.converged;
  estimate.message = start.converged ? solution.solution.message : start.message;
  estimate.iterations = start.iterations;
  estimate.iterations.insert(estimate.iterations.end(),
                             solution.solution.iterations.begin() + 1,
                             solution.solution.iterations.end());
  JudgeMarkers(observations, markers, solution, &estimate);
  return estimate;
}

}  // namespace hexcal
