// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "apps/command.h"

namespace hexcal {

// hexcal import FORMAT FILES: other programs' files to a dataset.
Command ImportCommand();

}  // namespace hexcal
