// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace hexcal {

// How long one of several methods took.
struct MethodTime {
  std::string name;
  double seconds = 0.0;
  int iterations = 0;  // 0: none, a closed form
};

// The machine that a run was made on.
struct Host {
  std::string name;
  int processors = 0;  // that are online
  std::string system;  // of operation: its name, release and the kind of processor
};

// The record of a history that a run has become.
struct HistoryMark {
  std::string file;
  long number = 0;
  std::string head;  // its hash, 64 hexadecimal digits
};

// Where a result comes from: what may differ between two runs that give the same result.
struct RunRecord {
  std::string version;                                        // of hexcal and its libraries, lines
  std::string revision = "unknown";                           // the commit that was built
  std::string operator_name = {};                             // --operator
  std::vector<std::pair<std::string, std::string>> settings;  // flags and their values
  // Those settings that stand at a default which their value does not say, and what that is.
  std::vector<std::pair<std::string, std::string>> not_set;
  std::string call;                 // the command, for a shell; reports
  std::vector<std::string> inputs;  // the files that were read
  std::string started_utc;          // ISO 8601
  double seconds = 0.0;
  int threads = 1;
  Host host = {};
  std::vector<MethodTime> methods;     // hexcal compare and audit
  std::optional<HistoryMark> history;  // with --history
};

// run.json, format hexcal/run/1.
std::string RunJson(const RunRecord& record);

}  // namespace hexcal
