// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

namespace hexcal {

// What the data say of an effect that was given.
enum class GivenState { kConfirmed, kChanged, kNotSupported };
constexpr std::string_view NameOf(GivenState state) {
  return state == GivenState::kConfirmed ? "confirmed"
         : state == GivenState::kChanged ? "changed"
                                         : "not supported";
}
struct GivenJudgement {
  double p_absent = 1.0;     // of numbers as far from zero, were the effect not there
  double p_unchanged = 1.0;  // of numbers as far from the model's, were those right
  GivenState state = GivenState::kConfirmed;
};

}  // namespace hexcal
