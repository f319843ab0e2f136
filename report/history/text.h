// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "report/history/check.h"
#include "report/history/trend.h"

namespace hexcal {

// Histories for people. What stands in the file is shown without control characters.

// A line a record: number, when, dataset, command, who, the beginning of its hash.
std::string HistoryListText(const std::vector<StoredRecord>& rows);

// All of one record.
std::string HistoryRecordText(const StoredRecord& row);

// The chart of each dataset.
std::string HistoryTrendText(const std::vector<DatasetTrend>& trends, const TrendOptions& options);

// "FILE: 12 records, intact" with the head, or what is not as it was written.
std::string HistoryCheckText(const std::string& path,
                             std::size_t records,
                             const HistoryCheck& check);

// What the chart says of a record: "in control", "OUT OF CONTROL: ...", why it is left out.
std::string VerdictText(const DatasetTrend& trend, std::size_t index);

// The parameters in which a record is out of control, with sizes: "base.dz +0.21 mm (limit 0.12)";
// where only all 12 together are, that.
std::string OutOfControlText(const TrendPoint& point);

}  // namespace hexcal
