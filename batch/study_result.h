// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "batch/row.h"
#include "batch/study.h"

namespace hexcal {

// What an estimator made of one draw.
struct StudyResult {
  BaseAndTool mounts;
  bool converged = false;
  std::string message;
  std::vector<IterationRecord> iterations;
  std::optional<Estimate> estimate;    // with covariance: not of closed forms
  std::optional<Discovery> discovery;  // whose machine predicts
};

// Columns of a study's rows, the same for every estimator.
std::vector<Column> StudyColumns(int records);

// The cells of a row. NaN for what the estimator does not say.
std::vector<Cell> StudyCells(const Study& study,
                             std::int64_t task,
                             const StudyEstimator& estimator,
                             const StudyResult& result);

// Which of the truth's effects were found, under their names or as what they could also be.
struct Detection {
  int hidden = 0;       // names of effects in the truth
  int named = 0;        // of these, found
  int false_names = 0;  // found, and neither they nor what they could also be are in the truth
};
Detection DetectionOf(const Machine& truth, const Discovery& discovery);

}  // namespace hexcal
