// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "estimator/calibrate.h"
#include "estimator/certificate.h"
#include "estimator/convergence_map.h"
#include "estimator/cross_validation.h"
#include "estimator/method.h"
#include "estimator/monte_carlo.h"

namespace hexcal {

struct CompareOptions {
  CalibrateOptions calibrate;  // its solver and error are those of each method
  MarkersOf markers;           // for the solution by marker; may be empty
  int folds = 5;               // of the cross-validation
  int draws = 10000;           // of the Monte Carlo check
  bool keep_draws = false;     // in its result
  // In place of the repetition of base and tool alone.
  std::function<PropagationCheck(const MonteCarloOptions&)> repeat = {};
  int starts = 20;  // of each cell of the convergence maps; 0: none
  std::uint64_t seed = 1;
  int threads = 1;  // the result does not depend on it
  // What is being done, how far it is, of how much.
  std::function<void(std::string_view, long, long)> progress;
};

// One method's answer, judged as all are.
struct MethodResult {
  Method method;
  MethodFit fit;
  // fit [-] the nonlinear solution in standard deviations of that; NaN where the data determine
  // none.
  Vector12d sigmas = Vector12d::Zero();
  double rmspe = 0.0,
         rmsoe = 0.0;  // Eq. (42) over measured [-] predicted, for every method; m, rad
  std::optional<HeldOutError> held_out;  // nothing where there are too few poses
  double seconds = 0.0;                  // of one run, the fastest of some
};

struct Comparison {
  std::vector<MethodResult> methods;    // in the order of kMethods; kMarker only with markers
  Estimate reference;                   // the nonlinear solution
  Certificate certificate;              // of it
  PropagationCheck propagation;         // of its covariance
  ConvergenceMap paper_map, twist_map;  // empty where no starts are asked for
  int folds = 0;                        // that the poses fell into; 0: too few poses
};

Comparison Compare(const Observations& observations,
                   const std::optional<BaseAndTool>& initial,
                   const CompareOptions& options);

}  // namespace hexcal
