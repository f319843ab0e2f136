// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>

#include "model/effect.h"

namespace hexcal {

// name, index, parameters and standard_deviation (a number or a list each, SI; null where not
// estimated), units; found, for a fault of the data; found and reference, for an unknown.
nlohmann::ordered_json JsonEffect(const Effect& effect);

// The same, each key by itself.
nlohmann::ordered_json JsonParameters(const Effect& effect);
nlohmann::ordered_json JsonDeviations(const Effect& effect);
nlohmann::ordered_json JsonUnits(const Effect& effect);

// found and reference, where there are such.
void AddDescription(const Effect& effect, nlohmann::ordered_json* object);

}  // namespace hexcal
