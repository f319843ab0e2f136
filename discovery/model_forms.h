// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "discovery/form.h"
#include "discovery/form_library.h"
#include "discovery/linear_problem.h"
#include "model/effect.h"

namespace hexcal {

// The effects of a model as forms, of which a problem has columns.

// What an effect leaves behind: the sum over its columns of value times column. Each column is of
// a number that the effect is linear in, taken at zero, all others as they are.
struct EffectSignal {
  FormDefinition form;
  Eigen::VectorXd values;
};
EffectSignal SignalOf(const Effect& effect);

// An effect's numbers that calibrate --model moves (FreeEffect), at their values. scale: 1-sigma of
// the prior that it holds them with; 0: none.
FormDefinition FreeFormOf(const Effect& effect);

// Some forms of a library and what they share columns with. Gives, for each asked form, its place.
FormLibrary SomeForms(const FormLibrary& library,
                      const std::vector<int>& forms,
                      std::vector<int>* places);

}  // namespace hexcal
