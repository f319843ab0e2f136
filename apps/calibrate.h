// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "apps/command.h"

namespace hexcal {

// hexcal calibrate DATASET... --out=DIR
Command CalibrateCommand();

}  // namespace hexcal
