// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "estimator/pivot.h"
#include "report/html/page.h"

namespace hexcal {

// Pictures of a pivoting, each with the table of its numbers. mm and degrees. poses: those that the
// result is of.

// The tool's frames, each tied to where it puts the tip, about the pivot.
Chart PivotSceneChart(const PivotPoses& poses, const PivotResult& result);

// Where each reading puts the tip less the pivot, along the axes of W; what was left out apart.
Chart PivotResidualChart(const PivotResult& result);

// The same in squared sigmas by its own noise, beside the limit of 95 %.
Chart PivotSigmasChart(const PivotResult& result);

// How far the poses tilt three directions of the tool, beside what noise does and what is needed.
Chart TiltChart(const PivotResult& result, const PivotOptions& options);

}  // namespace hexcal
