// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "discovery/discovery.h"
#include "discovery/investigation.h"

namespace hexcal {

// What a finished investigation says: the steps that led to it, the gap before and after, the
// effects with what they could also be, where the gap is, what would have been seen, the verdict.
// The result has its machine and its estimates already.
void FillFindings(const Investigation& work, Discovery* result);

}  // namespace hexcal
