// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "config/strict_yaml.h"
#include "model/effect.h"

namespace hexcal {

// The list under effects: of a model, in m and rad, back and forth to the last bit:
//   - {name, index: [..], parameters: {..}, standard_deviation: {..}, reference: {..}, found: {..}}
// A parameter of one number is a number, others are lists; what is not known of a standard
// deviation is null. InputError for a name, a parameter or a reference that is none, for wrong
// sizes and for numbers that are not finite.
std::vector<Effect> ReadEffects(const YamlNode& node);
// "effects: []" or the key with an entry a line.
std::string WriteEffects(const std::vector<Effect>& effects);

}  // namespace hexcal
