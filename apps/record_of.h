// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "measurement/dataset.h"
#include "report/run_record.h"

namespace hexcal {

inline constexpr std::string_view kRunMark = R"("format": "hexcal/run/)";

// What run.json says of a run of the command on this dataset that took so long and ends now: every
// flag of the command with the value that it had in the end.
RunRecord RecordOf(std::string_view command, const Dataset& dataset, double seconds, int threads);
// The same of a run with these inputs.
RunRecord RecordOf(std::string_view command,
                   const std::vector<std::string>& inputs,
                   double seconds,
                   int threads);

}  // namespace hexcal
