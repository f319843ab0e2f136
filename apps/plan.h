// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace hexcal {

// hexcal plan DATASET --model=FILE --out=FILE
int RunPlan(const std::vector<std::string>& files);

}  // namespace hexcal
