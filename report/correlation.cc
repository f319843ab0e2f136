// SPDX-License-Identifier: BSD-3-Clause
#include "report/correlation.h"

#include <cmath>

namespace hexcal {

std::vector<Correlation> StrongCorrelations(const Estimate& estimate) {
  constexpr double kStrong = 0.9;
  std::vector<Correlation> strong;
  const auto& determined = estimate.observability.determined;
  for (int a = 0; a < 12; ++a)
    for (int b = a + 1; b < 12; ++b) {
      const Matrix12d& c = estimate.covariance;
      const double value = c(a, b) / std::sqrt(c(a, a) * c(b, b));
      if (determined[a] && determined[b] && std::abs(value) > kStrong)
        strong.push_back({a, b, value});
    }
  return strong;
}

}  // namespace hexcal
