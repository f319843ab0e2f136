// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>
#include <vector>

#include "config/strict_yaml.h"
#include "measurement/dataset.h"

namespace hexcal {

// An entry of covariates: the column, its unit, and where it was declared.
struct CovariateDeclaration {
  std::string name;
  Unit unit;
  Location where;
};

// Whether the name of a covariate says what it is: time, temperature, payload, a velocity...
bool HasMeaning(std::string_view name);

// The mapping under covariates: (nullptr: none). InputError for a unit that is not known, or not of
// the kind that a name with a meaning asks for (time in a time unit, ...).
std::vector<CovariateDeclaration> ReadCovariates(const YamlNode* node);

// InputError for a value that the name does not allow (direction_1: -1, 0 or 1). value: as in the
// table.
void CheckCovariateValue(const std::string& name, double value, const Location& where);

}  // namespace hexcal
