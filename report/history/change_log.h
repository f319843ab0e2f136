// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "report/history/trend.h"
#include "report/html/page.h"
#include "report/run_record.h"

namespace hexcal {

// A calibration that is being appended to a history, among the ones of the same dataset before it.
struct ChangeLog {
  HistoryMark mark;
  DatasetTrend trend;  // the last of its records is this one
};
ChangeLog MakeChangeLog(const std::string& path, const PendingRecord& pending);

// The section of a report.
void AddChangeLog(const ChangeLog& log, HtmlPage* page);

// file, record, head; records: the last of them.
nlohmann::ordered_json ChangeLogJson(const ChangeLog& log);

}  // namespace hexcal
