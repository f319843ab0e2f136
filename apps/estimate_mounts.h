// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "estimator/calibrate.h"
#include "measurement/dataset.h"
#include "model/machine.h"

namespace hexcal {

// The dataset's first guess. InputError where --start=initial asks for one that it does not have.
std::optional<BaseAndTool> InitialOf(const Dataset& dataset, const CalibrateOptions& options);

// Base and tool of a dataset as the flags want it: by poses or by markers, certified where there is
// something to certify. observations: of this dataset.
Estimate EstimateMounts(const Dataset& dataset,
                        const Observations& observations,
                        const CalibrateOptions& options);

// The machine that was calibrated, without effects.
Machine MachineOf(const Dataset& dataset, const Estimate& estimate);

}  // namespace hexcal
