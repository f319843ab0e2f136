// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "batch/row.h"
#include "discovery/discovery.h"
#include "estimator/estimate.h"
#include "measurement/dataset.h"

namespace hexcal {

// What a batch keeps of each calibration and of each discovery: the first column is the dataset's
// file, which the cells leave out. SI units. What the data do not determine has no number.
const std::vector<Column>& CalibrationColumns();
std::vector<Cell> CalibrationCells(const Dataset& dataset, const Estimate& estimate);

const std::vector<Column>& DiscoveryColumns();
std::vector<Cell> DiscoveryCells(const Dataset& dataset, const Discovery& discovery);

// Of an estimate that cannot be trusted.
std::string WhyUntrusted(const Estimate& estimate);

}  // namespace hexcal
