// SPDX-License-Identifier: BSD-3-Clause
#include "report/repeated_as.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace hexcal {

std::array<double, 2> UncertaintyRatios(const RepeatedAs& repeated, const Estimate& reported) {
  std::array<double, 2> range = {std::numeric_limits<double>::infinity(), 0.0};
  for (int i = 0; i < 12; ++i) {
    if (!reported.observability.determined[i]) continue;
    const double ratio =
        std::sqrt(reported.covariance(i, i) / repeated.estimate.covariance_unscaled(i, i));
    range = {std::min(range[0], ratio), std::max(range[1], ratio)};
  }
  return range;
}

std::string RepeatedText(const RepeatedAs& repeated, const Estimate& reported) {
  const auto [least, most] = UncertaintyRatios(repeated, reported);
  return fmt::format(
      "Repeated is {}{}. The standard uncertainties of the 12 that this report states are {:.3f} "
      "to "
      "{:.3f} times those of first order with the noise as it is drawn, which the repetition "
      "checks{}.",
      repeated.is_audits ? "the fit of this report: " : "",
      repeated.words,
      least,
      most,
      repeated.is_audits ? "" : "; the fit of this report itself is not repeated");
}

}  // namespace hexcal
