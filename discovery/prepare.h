// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "discovery/investigation.h"

namespace hexcal {

// What precedes the search for what is missing.

// The dataset as the model of the options sees it, markers that carry each other's name put right.
struct MendedDataset {
  Dataset dataset;
  std::vector<FaultFound> swaps;
};
MendedDataset MendMarkers(const Dataset& dataset, const DiscoverOptions& options);

// Where the linear problem is: base and tool, and the effects of a model as the data have them.
struct Prepared {
  Estimate base_and_tool;
  Mounts mounts;
  std::vector<Effect> given_now;
};

// Mends the faults of the data and makes the problem of what base and tool, and the effects of a
// model, leave. InputError where the dataset cannot be calibrated.
Prepared Prepare(Investigation* work);

Selection SelectEffects(const Investigation& work, int most_effects);

}  // namespace hexcal
