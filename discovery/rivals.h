// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "discovery/discovery.h"
#include "discovery/gap_noise.h"
#include "discovery/linear_problem.h"

namespace hexcal {

// What each chosen form could also be: families that explain the same data nearly as well, all
// others chosen given, and those that poses like these could not tell from it (Teunissen 2018: the
// test statistics' correlation decides, not the size of the effect alone). By kind poses: gauges.
std::vector<std::vector<Rival>> RivalsOf(const LinearProblem& problem,
                                         const GapNoise& noise,
                                         const std::vector<int>& chosen,
                                         bool kind_poses);

// What would tell one family from another, in words.
std::string WhatTellsApart(const std::string& name, const std::string& rival);

}  // namespace hexcal
