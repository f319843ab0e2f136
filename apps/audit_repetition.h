// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "estimator/calibrate.h"
#include "estimator/monte_carlo.h"
#include "measurement/dataset.h"
#include "report/repeated_as.h"
#include "report/result_json.h"

namespace hexcal {

// What an audit without effects repeats: its own fit where that is one by poses, on the poses that
// it used; in place of a fit by markers the nonlinear one by the same poses.
class AuditRepetition {
 public:
  // All must outlive it. estimate: of these options.
  AuditRepetition(const Dataset& dataset,
                  const Observations& observations,
                  const CalibrateOptions& options,
                  const ResultHeader& header,
                  const Estimate& estimate);

  PropagationCheck Run(const MonteCarloOptions& repeat);

  // After Run.
  const std::optional<RepeatedAs>& repeated() const { return repeated_; }

 private:
  const Dataset& dataset_;
  const CalibrateOptions& options_;
  const ResultHeader& header_;
  const Estimate& estimate_;
  Observations used_;  // without the poses that were rejected
  std::optional<RepeatedAs> repeated_;
};

}  // namespace hexcal
