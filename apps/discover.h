// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "apps/command.h"

namespace hexcal {

// hexcal discover DATASET --out=DIR
Command DiscoverCommand();

}  // namespace hexcal
