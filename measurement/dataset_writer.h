// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "measurement/dataset.h"

namespace hexcal {

// The files of a dataset as (name, content): dataset.yaml, poses.csv and measured.csv or
// markers.csv, in m and rad; numbers to the last bit, so that ReadDataset gives the same dataset
// again.
std::vector<std::pair<std::string, std::string>> WriteDataset(const Dataset& dataset);

}  // namespace hexcal
