// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "estimator/estimate.h"
#include "estimator/linearized.h"

namespace hexcal {

struct ConvergenceMapOptions {
  int starts = 20;  // a cell
  std::uint64_t seed = 1;
  int threads = 1;                           // the result does not depend on it
  std::function<void(long, long)> progress;  // done, of; from the calling thread
};

// From which starts the linearized iteration arrives. A start has both mounts off: turned by so
// much about any axis and moved by so much in any direction.
struct ConvergenceMap {
  std::vector<double> rotation_errors;     // rad
  std::vector<double> translation_errors;  // m
  std::vector<std::vector<double>> share;  // [rotation][translation]: of the starts that arrive
  bool has_limit = false;  // started at the solution the iteration stays near it and stands still
};

// To arrive is to be, after the iterations that the options allow, within a tenth of a standard
// deviation of where the iteration leads from the solution itself. Of many poses 60 are taken.
// whiteners: one an observation, or empty for the paper's equal weights.
ConvergenceMap MapConvergence(const std::vector<Observation>& observations,
                              const std::vector<Matrix6d>& whiteners,
                              const Estimate& solution,
                              const LinearizedOptions& linearized,
                              const ConvergenceMapOptions& options);

}  // namespace hexcal
