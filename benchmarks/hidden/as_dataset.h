// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "hidden/hidden_case.h"
#include "measurement/dataset.h"

namespace hexcal::hidden {

// The one place where the generator meets hexcal: a case as a reader of its files would have it.
Dataset AsDataset(const Case& made);

// The same case as a table of poses: in frame W the tool's pose as the tracker has it, with noise
// along the axes of T. Of what the tracker misreads, a pose keeps the place alone. The tracker's
// frame is W.
Dataset AsPoseDataset(const Case& made, Dice* dice);

Pose3d AsPose(const Motion& motion);
Motion AsMotion(const Pose3d& pose);

}  // namespace hexcal::hidden
