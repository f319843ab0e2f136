// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "estimator/calibrate.h"
#include "measurement/dataset.h"
#include "report/result_json.h"

namespace hexcal {

// The flags of calibrate as the estimator's options.
CalibrateOptions CalibrateOptionsFromFlags();

// Whether --residual makes this dataset's calibration one by marker readings. UsageError where it
// asks for what the dataset or the solver does not have.
bool IsByMarkers(const Dataset& dataset, const CalibrateOptions& options);

// UsageError for options that a model with effects leaves no room for.
void RequireOptionsForEffects(const CalibrateOptions& options);

// What a result of these options says of how it was made.
ResultHeader HeaderOf(const std::string& dataset, const CalibrateOptions& options, bool by_markers);

}  // namespace hexcal
