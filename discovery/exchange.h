// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <vector>

#include "discovery/design_model.h"
#include "discovery/design_rows.h"

namespace hexcal {

// Squared distance of two effects in standard deviations from which one is taken for the other less
// than once in twenty: half the distance is the quantile of 0.05.
inline constexpr double kApart = 10.8;

// What poses are chosen for: base and tool, and effects that are to be told apart. A pair is as far
// apart as the effect and the rival's form that is nearest to it.
struct DesignGoal {
  DesignModel parameters;
  std::vector<std::vector<DesignModel>> pairs;
  // Of the parameters' log determinant beside the pairs; without pairs nothing else counts.
  double parameter_weight = 1.0;
};

// The poses, out of the candidates, that serve the goal best beside those of `known`: one after
// another, then exchanged one for another until no exchange helps. A pair counts by
// ln(1 + distance / kApart): what is far apart already needs no more. No candidate is taken twice.
std::vector<int> ChoosePoses(const DesignGoal& goal,
                             const DesignRows& rows,
                             const std::vector<int>& known,
                             const std::vector<int>& candidates,
                             int count,
                             const std::function<void(int done, int of)>& progress);

// What ChoosePoses makes large.
double UtilityOf(const DesignGoal& goal, const DesignRows& rows, const std::vector<int>& poses);

}  // namespace hexcal
