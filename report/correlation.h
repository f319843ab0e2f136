// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "estimator/estimate.h"

namespace hexcal {

// How far the errors of two of the 12 parameters hang together, from -1 to 1.
struct Correlation {
  int a = 0, b = 0;
  double value = 0.0;
};

// Those above 0.9 in size, of parameters that the data determine.
std::vector<Correlation> StrongCorrelations(const Estimate& estimate);

}  // namespace hexcal
