// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "report/html/page.h"
#include "report/left_over.h"

namespace hexcal {

// What is left over marker by marker: RMS beside what the noise explains, and every residual along
// the tracker's axes. Nothing where the calibration was not by markers.
void AddMarkers(const LeftOver& left, HtmlPage* page);

}  // namespace hexcal
