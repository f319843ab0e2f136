// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "discovery/discovery.h"
#include "report/pose_residuals.h"
#include "report/run_record.h"
#include "report/scene.h"

namespace hexcal {

// report.html of a discovery: one file that opens offline (report/html/page.h). No times.
// record: for "How to reproduce": versions, settings and inputs are shown. scene, residuals: of the
// discovery.
std::string DiscoveryHtml(const std::string& dataset,
                          const RunRecord& record,
                          const Discovery& discovery,
                          const Scene& scene,
                          const PoseResiduals& residuals);

}  // namespace hexcal
