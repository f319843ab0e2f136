// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "estimator/compare.h"
#include "report/coverage.h"
#include "report/requirement.h"
#include "report/workspace.h"

namespace hexcal {

// A linearized solution beside the nonlinear one by poses, both of the same noise. NaN where not
// determined.
struct LinearizedSolution {
  std::string name;  // "paper" (Eq. 22, equal weights), "twist" (weights as the nonlinear one's)
  std::string title;
  Estimate estimate;
  Vector12d over_u;  // linearized [-] nonlinear in standard uncertainties of the nonlinear one
  Vector12d ratio;   // of standard uncertainties, linearized over nonlinear
  struct AtPoint {
    double centre = 0.0, largest = 0.0;  // between the two predictions: where, and at most, m
    double ratio = 0.0;  // of the calibration's RMS at the centre, linearized over nonlinear
  };
  std::vector<AtPoint> points;  // named ones, in the middle of the workspace and over its places
};

// What repetition makes of a parameter's standard uncertainty by first order.
struct RepeatedParameter {
  double ratio = 0.0;  // by repetition over first order
  Coverage coverage;   // of -+1.96 standard uncertainties by first order
};

struct Linearity {
  std::vector<LinearizedSolution> solutions;
  std::vector<RepeatedParameter> repeated;  // of the 12; empty where no draws were made
};

// comparison: of these observations, with its draws kept. levels: the noise where the dataset
// states none.
Linearity CheckLinearity(const Observations& observations,
                         const std::optional<BaseAndTool>& initial,
                         const NoiseLevels& levels,
                         const Comparison& comparison,
                         const std::vector<NamedPoint>& points,
                         const Pose3d& centre,
                         const std::vector<Place>& places);

}  // namespace hexcal
