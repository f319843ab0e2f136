// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "batch/store.h"

namespace hexcal {

// All rows of the store in the order of their indices, the file whole or not at all: the same bytes
// however the rows came into the store.
void WriteCsv(const std::string& path, const Batch& batch, Store* store);

}  // namespace hexcal
