// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace hexcal {

// hexcal simulate DATASET --model=FILE --out=DIR
int RunSimulate(const std::vector<std::string>& files);

}  // namespace hexcal
