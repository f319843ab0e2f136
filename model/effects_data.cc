// SPDX-License-Identifier: BSD-3-Clause
#include <utility>

#include "model/effect_terms.h"

namespace hexcal {

// Faults of the data: nothing to add to a machine, but something to mend in what was recorded.
std::vector<EffectKind> DataFaults() {
  const auto fault =
      [](std::string_view name, std::string_view cause, std::vector<std::string_view> needs) {
        return EffectKind{name, "data", "–", "discrete", cause, {}, std::move(needs)};
      };
  return {
      fault("wrong_rotation_order",
            "The three angles of a reported pose turn in another order than Eq. (2).",
            {}),
      fault("transposed_rotation",
            "The reported rotation takes the base to the platform, not the platform to the base.",
            {}),
      fault("wrong_quaternion_order",
            "The scalar part of the reported quaternion stands last, not first.",
            {}),
      fault("swapped_legs", "Two legs' readings stand in each other's column.", {"legs"}),
      fault("swapped_markers", "Two markers carry each other's name.", {"markers"}),
      fault("shifted_rows", "Poses and measurements are paired a row or more apart.", {"order"}),
      fault("wrong_unit", "Lengths or angles are in another unit than declared.", {}),
  };
}

}  // namespace hexcal
