// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "estimator/estimate.h"
#include "estimator/marker_solver.h"

namespace hexcal {

// Fills in all that follows from a solution by markers, as Judge does for one by poses.
void JudgeMarkers(const Observations& observations,
                  const MarkerObservations& markers,
                  const MarkerSolution& solution,
                  Estimate* estimate);

// What this solution leaves of every reading, by item of the observations.
std::vector<std::vector<MarkerMisfit>> MisfitsByItem(const MarkerObservations& markers,
                                                     std::size_t items,
                                                     const MarkerSolution& solution);

}  // namespace hexcal
