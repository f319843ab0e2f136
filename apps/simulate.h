// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "apps/command.h"

namespace hexcal {

// hexcal simulate DATASET --model=FILE --out=DIR
Command SimulateCommand();

}  // namespace hexcal
