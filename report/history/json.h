// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "report/history/check.h"
#include "report/history/trend.h"

namespace hexcal {

// Histories for programs (docs/history.md): an object on one line, without a newline. SI units.
std::string HistoryListJson(const std::string& path,
                            const std::vector<StoredRecord>& rows,
                            const HistoryCheck& check);
std::string HistoryRecordJson(const StoredRecord& row);
std::string HistoryTrendJson(const std::string& path,
                             const std::vector<DatasetTrend>& trends,
                             const DatasetTrendOptions& options);
std::string HistoryCheckJson(const std::string& path,
                             std::size_t records,
                             const HistoryCheck& check);

}  // namespace hexcal
