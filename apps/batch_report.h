// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "apps/batch_manifest.h"
#include "batch/store.h"
#include "batch/study_summary.h"

namespace hexcal {

// Says on stdout and stderr what came of a batch whose results are all in the store; gives the exit
// status. summaries: of a study.
int ReportBatch(const Manifest& manifest,
                const std::vector<StudySummary>& summaries,
                const std::string& folder,
                Store* store);

}  // namespace hexcal
