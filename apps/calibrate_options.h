// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "estimator/calibrate.h"
#include "report/result_json.h"

namespace hexcal {

// The flags of calibrate as the estimator's options.
CalibrateOptions CalibrateOptionsFromFlags();

// What a result of these options says of how it was made.
ResultHeader HeaderOf(const std::string& dataset, const CalibrateOptions& options);

}  // namespace hexcal
