// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "estimator/pivot.h"

namespace hexcal {

// Data snooping for pivoting, as FindOutliers does it for base and tool: the solution of three
// poses around which the best half of all lies closest (drawn with a fixed seed) grows to all that
// agree with it; then the worst goes out as long as it is significant and the best comes back as
// long as it is not. A pose is judged by what the others predict for it (three degrees of freedom;
// chi-square for a stated noise that the others do not disprove, else F), at Sidak's level. Fewer
// than six poses list none.
std::vector<PivotOutlier> FindPivotOutliers(const PivotPoses& poses, const PivotOptions& options);

}  // namespace hexcal
