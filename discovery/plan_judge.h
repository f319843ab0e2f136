// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "discovery/design_model.h"
#include "discovery/plan.h"

namespace hexcal {

// What a plan is worth, by exact least squares on its rows.

// Standard deviations of the last 12 unknowns of a model; NaN where the poses do not determine one.
Vector12d Deviations(const DesignModel& parameters,
                     const DesignRows& rows,
                     const std::vector<int>& poses);

// The distance of what the unknowns of the nearest of these models leave of the signal.
double DistanceOf(const std::vector<DesignModel>& forms,
                  const DesignRows& rows,
                  const std::vector<int>& poses);

// Sizes and distances before and after.
void MeasureDistances(const DesignRows& rows,
                      const DesignModel& alone,
                      const std::vector<DesignModel>& forms,
                      const std::vector<int>& before,
                      const std::vector<int>& after,
                      RivalPair* pair);

// If all poses of a pool were measured; whether even then nothing is left.
void MeasureWholePool(const DesignRows& rows,
                      const DesignModel& alone,
                      const std::vector<DesignModel>& forms,
                      RivalPair* pair);

// Separation and poses needed, of a pair whose distances are known and of so many planned poses.
void Classify(int planned, RivalPair* pair);

// What each planned pose is for. pairs: as the plan's; empty where the plan is for parameters.
std::vector<PoseReason> Reasons(const DesignModel& parameters,
                                const std::vector<std::vector<DesignModel>>& pairs,
                                const DesignRows& rows,
                                const std::vector<int>& known,
                                const std::vector<int>& planned);

}  // namespace hexcal
