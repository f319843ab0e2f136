// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "estimator/estimate.h"
#include "report/result_json.h"

namespace hexcal {

// Does what is left over agree with the noise that was stated? Tested is what least squares leaves,
// each pose by its noise alone (Estimate::OfNoise): the sum that a loss or the paper's equal
// weights leave has no chi-square distribution.
struct GlobalTest {
  bool is_stated = false;  // else the noise was estimated from what is left over: nothing to test
  NoiseMisfit tested;
  bool is_of_fit = true;         // tested is the fit's own chi-square
  double low = 0.0, high = 0.0;  // 95 % limits of chi-square
  bool is_too_large = false, is_too_small = false;
  bool is_rounding = false;  // nothing but rounding is left over; for MakeAudit to say
};

// Where only rounding is left over, in one sentence without its end.
inline constexpr const char* kOnlyRounding =
    "only the rounding of the numbers is left over: nothing can be said of the noise";

GlobalTest GlobalTestOf(const Estimate& estimate);

// Sentences: what is left over, what of it is tested, and how that came out.
std::string GlobalTestText(const GlobalTest& test,
                           const ResultHeader& header,
                           const Estimate& estimate);

// The same for a terminal, one line or two.
std::string GlobalTestLines(const GlobalTest& test, const Estimate& estimate);

}  // namespace hexcal
