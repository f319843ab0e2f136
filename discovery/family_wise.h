// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "discovery/score.h"

namespace hexcal {

// How often noise alone looks as good as what was found, after all forms of all families have been
// tried: a parametric bootstrap of white noise through the same projections. Each family first pays
// for its own search (a period among hundreds, a leg among six), then families are compared on
// equal terms (Westfall and Young 1993, minP).
class FamilyWise {
 public:
  // draws: at least 99. Equal seeds give equal numbers.
  FamilyWise(const Scorer& scorer, int draws, std::uint64_t seed);

  // -log10 of a family's own p, its search paid for.
  double Paid(int family, double minus_log10_p) const;
  // Of the best family of the data. Beyond what the draws reach it is the bound of Sidak over
  // families, so that it keeps getting smaller.
  double PValue(double paid) const;

 private:
  std::vector<double> tests_;  // effective number of forms tried, a family
  std::vector<double> best_;   // the best paid -log10 p of each draw, ascending
};

}  // namespace hexcal
