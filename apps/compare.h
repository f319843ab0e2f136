// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "apps/command.h"

namespace hexcal {

// hexcal compare DATASET --out=DIR
Command CompareCommand();

}  // namespace hexcal
