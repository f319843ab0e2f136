// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "estimator/observations.h"
#include "measurement/dataset.h"
#include "model/effect.h"

namespace hexcal {

// A fault of the data that, mended, lets base and tool fit much better.
struct FaultFound {
  Effect effect;
  double gain = 0.0;  // fall of -2 ln likelihood, noise levels free in both
};

// The best of all faults of the table, each tried with base and tool refitted; nothing where none
// gains clearly more than trying so many could by chance. Robot poses only: markers are tried in
// their bodies.
std::optional<FaultFound> FindFault(const Dataset& dataset, const Observations& observations);

}  // namespace hexcal
