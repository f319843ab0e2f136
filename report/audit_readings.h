// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "estimator/estimate.h"
#include "estimator/reading_check.h"
#include "measurement/dataset.h"
#include "report/html/page.h"

namespace hexcal {

// Every marker reading of an audit against all others.
struct ReadingReport {
  ReadingOptions options;
  ReadingSearch search;
  std::vector<std::string> labels;  // of the observations
  std::vector<bool> is_used;        // of them: not rejected as a pose
  std::vector<ReadingCheck> worst_first;

  int BadAndUsed() const;
};

// Nothing where poses were measured. observations, estimate: of this dataset, without effects.
std::optional<ReadingReport> CheckReadings(const Dataset& dataset,
                                           const Observations& observations,
                                           const Estimate& estimate,
                                           const ReadingOptions& options);

void AddDoubtsOfReadings(const std::optional<ReadingReport>& readings,
                         std::vector<std::string>* doubts);
void AddReadings(const ReadingReport& readings, HtmlPage* page);
std::string ReadingLines(const ReadingReport& readings);
nlohmann::ordered_json JsonReadings(const ReadingReport& readings);

}  // namespace hexcal
