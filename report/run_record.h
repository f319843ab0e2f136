// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace hexcal {

// Where a result comes from: what may differ between two runs that give the same result.
struct RunRecord {
  std::string version;                                        // of hexcal and its libraries, lines
  std::vector<std::pair<std::string, std::string>> settings;  // flags and their values
  std::vector<std::string> inputs;                            // the files that were read
  std::string started_utc;                                    // ISO 8601
  double seconds = 0.0;
  int threads = 1;
};

// run.json, format hexcal/run/1.
std::string RunJson(const RunRecord& record);

}  // namespace hexcal
