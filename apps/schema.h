// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "apps/command.h"

namespace hexcal {

// hexcal schema [NAME [COMMAND]]
Command SchemaCommand();

}  // namespace hexcal
