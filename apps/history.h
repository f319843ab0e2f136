// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "apps/command.h"

namespace hexcal {

// hexcal history list|show|trend|verify FILE: what --history has kept.
Command HistoryCommand();

}  // namespace hexcal
