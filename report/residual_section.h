// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "report/html/page.h"
#include "report/pose_residuals.h"
#include "report/scene.h"

namespace hexcal {

// The pictures of what is left over that all reports share, within a section: along the axes
// against order and time, in space, as a distribution, and in leg space.
void AddResidualPictures(const PoseResiduals& residuals, const Scene& scene, HtmlPage* page);

}  // namespace hexcal
