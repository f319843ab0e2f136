// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "discovery/form.h"
#include "discovery/linear_problem.h"
#include "measurement/dataset.h"
#include "model/effect.h"
#include "model/visit.h"

namespace hexcal {

// All forms of all effects that a dataset can be tested for.
struct FormLibrary {
  std::vector<Family> families;
  std::vector<FormDefinition> forms;
  // Effects that cannot be tested, and what they need.
  std::vector<std::pair<std::string, std::string>> not_testable;
};

// rows: of the measured poses. Every effect of the table that the data drive, each in its forms
// (one leg, all alike, each its own; every period, time of a step and time constant worth trying);
// then descriptions: smooth functions of each driver at each site, for what has no name.
FormLibrary MakeFormLibrary(const Dataset& dataset,
                            const std::vector<Visit>& visits,
                            const std::vector<int>& rows);

}  // namespace hexcal
