// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "estimator/calibrate.h"
#include "estimator/marker_observations.h"

namespace hexcal {

// Base and tool with covariance by maximum likelihood of the marker readings (residuals/
// marker_batch.h), from the solution by poses on, which also says where there is none. A sigma that
// is not stated is estimated. Outliers are those of the poses. options.solver must be kNonlinear;
// options.noise is of poses and not used. chi_square is of the readings and of the robot's draws,
// its degrees of freedom are those of the mean readings less all that was estimated; noise.position
// and noise.orientation are those of the tool poses that the readings are worth.
Estimate CalibrateMarkers(const Observations& observations,
                          const MarkerObservations& markers,
                          const std::optional<BaseAndTool>& initial,
                          const CalibrateOptions& options);

}  // namespace hexcal
