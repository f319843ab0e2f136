// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <exception>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "measurement/dataset.h"
#include "report/history/change_log.h"

namespace hexcal {

// Before anything is computed: refuses a --history that could not be appended to (InputError,
// OutputError). Nothing without --history.
void CheckHistoryFlag();

// A run's record on its way into --history: begun before the results are written, since they print
// its hash; appended after them. Nothing without --history.
class HistoryEntry {
 public:
  // Throws nothing: what goes wrong waits for Append, so that the results are written first.
  // Arguments as MakeHistoryRecord's.
  HistoryEntry(std::string_view command,
               const Dataset& dataset,
               const RunRecord& run,
               const ResultHeader& header,
               const Estimate& estimate,
               const std::vector<Effect>& effects,
               const std::string& result);

  std::optional<HistoryMark> mark() const;
  const std::optional<ChangeLog>& log() const { return log_; }
  void Append();

 private:
  std::unique_ptr<PendingRecord> pending_;
  std::optional<ChangeLog> log_;
  std::exception_ptr error_;
};

}  // namespace hexcal
