// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "model/effect.h"

namespace hexcal {

// One number of an effect with its names: "leg 3", "gain". SI; the deviation is NaN where the
// number was not estimated.
struct EffectNumber {
  std::string part;  // "leg 3", "dx", "tool/t2 y"; empty where the parameter is one number
  double value = 0.0;
  double standard_deviation = 0.0;
  std::string unit;        // of the table of kinds; "phase" for an angle within a turn, rad
  bool is_carried = true;  // false: of a leg or joint that does not carry the effect, zero
};

struct EffectParameter {
  std::string name;  // of the table of kinds
  std::vector<EffectNumber> numbers;
  int columns = 0;  // 0: one number; else the numbers are a list, or rows of so many
};

// False for what is zero only because the effect does not use it: another leg's number, a search
// that was not made.
bool IsShown(const EffectNumber& number);

// Whether the coefficients of an unknown are lengths of legs, not twists.
bool IsOfLegs(const Effect& unknown);

// The parameters of an effect in the order of its kind, the coefficients of an unknown. Empty for a
// fault of the data.
// labels: words for what is in effect.index, one each or none.
std::vector<EffectParameter> ParametersOf(const Effect& effect,
                                          const std::vector<std::string>& labels);

// A number of an effect of this kind: "scale", "gain 3".
std::string FreeNumberName(const EffectKind& kind, int number);

}  // namespace hexcal
