// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "estimator/estimate.h"
#include "model/effect.h"
#include "report/readings.h"
#include "residuals/robust_loss.h"

namespace hexcal {

// What a result says of how it was made.
struct ResultHeader {
  std::string dataset;
  std::string solver;    // nonlinear | linearized
  std::string residual;  // pose
  std::string error;     // paper | twist; empty for the nonlinear solver
  // Of the dataset: by them an audit sees whether two results share any. May be empty.
  DatasetReadings readings = {};
  RobustLoss loss = {};
  bool is_sandwich = false;  // the covariance is
};

// result.json (docs/results.md), format hexcal/result/1: a key a line, an entry of a list of
// objects a line, no times. SI units. What the data cannot determine is null.
// effects: of the model, estimated together with base and tool.
std::string ResultJson(const ResultHeader& header,
                       const Estimate& estimate,
                       const std::vector<Effect>& effects = {});

// The same object on one line.
std::string ResultJsonLine(const ResultHeader& header,
                           const Estimate& estimate,
                           const std::vector<Effect>& effects = {});

}  // namespace hexcal
