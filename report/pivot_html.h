// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "estimator/pivot.h"
#include "report/run_record.h"

namespace hexcal {

// report.html of a pivoting: one file that opens offline (report/html/page.h). No times. poses,
// options: what the result is of.
std::string PivotHtml(const std::string& dataset,
                      const RunRecord& record,
                      const PivotPoses& poses,
                      const PivotOptions& options,
                      const PivotResult& result);

}  // namespace hexcal
