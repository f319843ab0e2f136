// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "apps/command.h"

namespace hexcal {

// hexcal batch MANIFEST --out=DIR
Command BatchCommand();

}  // namespace hexcal
