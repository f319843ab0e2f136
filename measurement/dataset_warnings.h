// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "measurement/dataset.h"

namespace hexcal {

// What is allowed but looks like a mistake: lengths of which one kind seems to be in the other unit
// (robot poses against what was measured, markers against their bodies, joints against robot
// poses), and joints of one plate that coincide.
std::vector<std::string> FindOddities(const Dataset& dataset);

}  // namespace hexcal
