// SPDX-License-Identifier: BSD-3-Clause
#include "report/coverage.h"

#include <fmt/format.h>

namespace hexcal {

Coverage CoverageOf(long inside, long of, double nominal) {
  constexpr double kConfidence = 0.95;
  return {inside, of, nominal, ClopperPearson(inside, of, kConfidence)};
}

std::string CoverageText(const Coverage& coverage) {
  return fmt::format("{:.1f} % ({:.1f} to {:.1f} %)",
                     100.0 * coverage.Share(),
                     100.0 * coverage.limits.low,
                     100.0 * coverage.limits.high);
}

}  // namespace hexcal
