// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "apps/command.h"

namespace hexcal {

// hexcal plan DATASET --model=FILE --out=FILE
Command PlanCommand();

}  // namespace hexcal
