// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "discovery/form_library.h"

namespace hexcal {

// Adds forms for effects that have no name in the table: a power of each driver at each site
// (twist of the base, twist of the tool, legs), but for those that a named effect is.
void AddDescribedForms(const Dataset& dataset,
                       const std::vector<Visit>& visits,
                       const std::vector<int>& rows,
                       FormLibrary* library);

}  // namespace hexcal
