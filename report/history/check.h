// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "report/history/store.h"

namespace hexcal {

// Something in a history that is not as it was written.
struct HistoryProblem {
  long number = 0;  // of the record; 0: of the whole
  std::string what;
};

struct HistoryCheck {
  std::vector<HistoryProblem> problems;
  std::string head;     // the hash of the last record; kNoHash where there is none
  long after_head = 0;  // records after the one with the hash that was asked for
  bool is_intact() const { return problems.empty(); }
};

// Whether every record is as it was written and follows the one before. head: a hash that a report
// printed; the record that has it, and so all before it, must be there. Empty: not asked for. A
// forger who writes all hashes anew is found by a head alone.
HistoryCheck CheckHistory(const std::vector<StoredRecord>& rows, const std::string& head = {});

}  // namespace hexcal
