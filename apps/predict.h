// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "apps/command.h"

namespace hexcal {

// hexcal predict DATASET --model=FILE --out=FILE.csv
Command PredictCommand();

}  // namespace hexcal
