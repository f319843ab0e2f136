// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace hexcal {

// hexcal predict DATASET --model=FILE --out=FILE.csv
int RunPredict(const std::vector<std::string>& files);

}  // namespace hexcal
