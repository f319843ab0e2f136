// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "batch/store.h"

namespace hexcal {

// All rows of the store in the order of their indices, the file whole or not at all: the same bytes
// however the rows came into the store. Through each of these connections to it, one or more, a
// piece at a time, each on a thread of its own.
void WriteCsv(const std::string& path, const Batch& batch, const std::vector<Store*>& stores);

}  // namespace hexcal
