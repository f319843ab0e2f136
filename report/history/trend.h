// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "estimator/mount_trend.h"
#include "report/history/store.h"

namespace hexcal {

// The calibrations of one dataset over time.
struct DatasetTrend {
  std::string dataset;
  std::vector<HistoryRecord> records;
  MountTrend trend;  // a point a record
  // The number of the earlier, trusted record of which a record evaluates the same readings anew,
  // a record; 0: none. It is no new measurement, and left out.
  std::vector<long> repeats;
  // Records that were made otherwise than the one before (solver, residual, effects), by index.
  std::vector<std::size_t> made_otherwise;
};

struct DatasetTrendOptions {
  std::string dataset;  // empty: each by itself
  long since = 1;       // records from this number on
  TrendOptions chart;
};

// In the order in which the datasets appear. Rows whose text is no record are left out.
std::vector<DatasetTrend> TrendsOf(const std::vector<StoredRecord>& rows,
                                   const DatasetTrendOptions& options);

// Seconds since 1970 of "2026-11-23T02:03:04Z"; NaN for anything else.
double SecondsOf(const std::string& utc);

// How a calibration was made, in words: "nonlinear by markers", "nonlinear by poses with
// leg_periodic; loss huber".
std::string WayOf(const HistoryRecord& record);

}  // namespace hexcal
