// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "apps/command.h"

namespace hexcal {

// hexcal audit DATASET --out=DIR
Command AuditCommand();

}  // namespace hexcal
