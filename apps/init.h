// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "apps/command.h"

namespace hexcal {

// hexcal init --out=DIR
Command InitCommand();

}  // namespace hexcal
