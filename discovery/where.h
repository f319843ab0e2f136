// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "discovery/discovery.h"
#include "discovery/gap_noise.h"
#include "discovery/linear_problem.h"
#include "discovery/select.h"

namespace hexcal {

// Where base and tool alone disagree with the measurement, whatever the cause is called: which
// poses (mean-shift test), legs, axes of the tool, drivers and sites. Each p pays for its list.
// noise: with what was found in the model, so that the gap does not pass for noise.
Where Localise(const LinearProblem& problem,
               const GapNoise& noise,
               const SelectionStep& first_step,
               const std::vector<std::string>& pose_labels,
               const std::vector<std::string>& family_sites,
               const std::vector<std::string>& family_drivers);

// The smallest size of each named family that would be found with a power of 80 %, in its first
// parameter.
std::vector<Detectable> DetectableSizes(const LinearProblem& problem,
                                        const GapNoise& noise,
                                        const std::vector<int>& chosen,
                                        double alpha,
                                        const std::vector<std::string>& units);

}  // namespace hexcal
