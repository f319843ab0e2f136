// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "apps/batch_manifest.h"
#include "batch/store.h"

namespace hexcal {

// Says on stdout and stderr what came of a batch whose results are all in the store; gives the exit
// status.
int ReportBatch(const Manifest& manifest, const std::string& folder, Store* store);

}  // namespace hexcal
