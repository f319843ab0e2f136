// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "report/run_record.h"

namespace hexcal {

// As the system tells it; empty and 0 where it does not.
Host ThisHost();

}  // namespace hexcal
