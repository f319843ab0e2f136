// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "apps/command.h"
#include "discovery/discover.h"

namespace hexcal {

// hexcal discover DATASET --out=DIR
Command DiscoverCommand();

// Its flags as options.
DiscoverOptions DiscoverOptionsFromFlags();

}  // namespace hexcal
