// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "estimator/compare.h"
#include "report/left_over.h"
#include "report/run_record.h"
#include "report/scene.h"

namespace hexcal {

// report.html of a comparison: one file that opens offline (report/html/page.h). No times.
// scene: of the nonlinear solution.
std::string CompareHtml(const std::string& dataset,
                        const RunRecord& record,
                        const Comparison& comparison,
                        const Scene& scene,
                        const LeftOver& left);

}  // namespace hexcal
