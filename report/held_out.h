// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "report/audit.h"

namespace hexcal {

// poses: those that the estimate used.
HeldOutTest HeldOutTestOf(const std::vector<PoseCheck>& poses);

}  // namespace hexcal
