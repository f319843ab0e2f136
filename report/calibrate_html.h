// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "report/frame_graph.h"
#include "report/left_over.h"
#include "report/result_json.h"
#include "report/run_record.h"
#include "report/scene.h"

namespace hexcal {

// report.html of a calibration: one file that opens offline (report/html/page.h). No times.
std::string CalibrateHtml(const ResultHeader& header,
                          const RunRecord& record,
                          const Estimate& estimate,
                          const FrameGraph& frames,
                          const Scene& scene,
                          const LeftOver& left);

}  // namespace hexcal
