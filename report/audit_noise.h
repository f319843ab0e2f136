// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "estimator/axis_noise.h"
#include "report/audit.h"

namespace hexcal {

// What the bodies' markers tell of their noise, where none was stated.
std::optional<AxisNoise> AxisNoiseOf(const Dataset& dataset, const Observations& observations);

// Why what is stated of a point's error may not hold: a noise that differs between the tracker's
// axes and was taken for alike, or a repetition with longer errors.
void AddDoubtsOfNoise(const Audit& audit, std::vector<std::string>* doubts);

}  // namespace hexcal
