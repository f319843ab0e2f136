// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "estimator/quantiles.h"

namespace hexcal {

// How many of so many were within what is to hold that share of them, and the 95 % limits of the
// share that this confirms (binomial; C. J. Clopper, E. S. Pearson, Biometrika 26 (1934)).
struct Coverage {
  long inside = 0, of = 0;
  double nominal = 0.95;
  BinomialInterval limits;

  double Share() const { return static_cast<double>(inside) / static_cast<double>(of); }
  bool HoldsNominal() const { return limits.low <= nominal && nominal <= limits.high; }
};
Coverage CoverageOf(long inside, long of, double nominal);  // of above 0

// "94.8 % (94.6 to 95.1 %)": the share, and the limits that so many confirm.
std::string CoverageText(const Coverage& coverage);

}  // namespace hexcal
