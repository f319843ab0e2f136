// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "measurement/importers/recording.h"

namespace hexcal {

// Any table, by the column map options.map: column_map.h.
Recording ReadColumnsFile(const std::string& path, const ImportOptions& options);

}  // namespace hexcal
