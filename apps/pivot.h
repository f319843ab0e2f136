// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "apps/command.h"

namespace hexcal {

// hexcal pivot FILE --out=DIR
Command PivotCommand();

}  // namespace hexcal
