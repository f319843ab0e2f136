// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "batch/store.h"
#include "batch/study.h"

namespace hexcal {

// What all draws of a cell say of an estimator. Shares and means are of the draws that are done;
// NaN where nothing is said.
struct StudySummary {
  const StudyCell* cell = nullptr;
  const StudyEstimator* estimator = nullptr;
  std::int64_t done = 0, untrusted = 0, failed = 0;
  double rms_position = 0.0;           // mean of the draws' RMS over the test poses, m
  double rms_position_measured = 0.0;  // the same to the poses as measured: Figure 5
  double rms_orientation = 0.0;        // rad
  Vector12d bias = Vector12d::Zero();  // mean error of the 12 parameters
  Vector12d rms_error = Vector12d::Zero();
  Vector12d coverage = Vector12d::Zero();  // of the 95 % intervals
  double mean_coverage = 0.0;              // over the 12
  double ellipsoid_coverage = 0.0;         // of the 95 % region of all 12
  double all_named = 0.0;                  // draws in which every hidden effect was named
  double false_names = 0.0;                // draws in which something was named that is not there
  double iterations = 0.0;
  std::vector<double> rmspe;  // after each of the first iterations: convergence
};

// One for each cell and estimator, cells first. Reads the store once, in order.
std::vector<StudySummary> Summarise(const Study& study, Store* store);

// summary.csv: a row each.
std::string SummaryCsv(const std::string& study, const std::vector<StudySummary>& summaries);

// For the terminal.
std::string SummaryTable(const std::string& study, const std::vector<StudySummary>& summaries);

}  // namespace hexcal
