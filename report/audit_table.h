// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "report/audit.h"

namespace hexcal {

// The verdict and what it rests on, for the terminal. UTF-8.
std::string AuditTable(const Audit& audit);

}  // namespace hexcal
