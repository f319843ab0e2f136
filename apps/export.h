// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "apps/command.h"

namespace hexcal {

// hexcal export FORMAT RESULT.json: a calibration for other programs.
Command ExportCommand();

}  // namespace hexcal
