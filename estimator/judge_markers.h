// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "estimator/estimate.h"
#include "estimator/marker_solver.h"

namespace hexcal {

// Fills in all that follows from a solution by markers, as Judge does for one by poses.
void JudgeMarkers(const Observations& observations,
                  const MarkerObservations& markers,
                  const MarkerSolution& solution,
                  Estimate* estimate);

}  // namespace hexcal
