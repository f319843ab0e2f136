// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace hexcal {

enum class CellKind { kInteger, kReal, kText };

// A column of a batch's results; its name is one in SQL and in CSV.
struct Column {
  std::string name;
  CellKind kind;
};

// Nothing: not known, or NaN.
using Cell = std::variant<std::monostate, std::int64_t, double, std::string>;

// What became of a task. Untrusted: there are numbers, but the 12 parameters cannot be trusted.
enum class RowStatus { kDone, kUntrusted, kFailed };
constexpr const char* NameOf(RowStatus status) {
  return status == RowStatus::kDone        ? "done"
         : status == RowStatus::kUntrusted ? "untrusted"
                                           : "failed";
}

// What one task gives.
struct Outcome {
  RowStatus status = RowStatus::kDone;
  std::string message;      // why it is not done
  std::vector<Cell> cells;  // one a column of the job; may be shorter
};

// A row as stored: status and message before the job's columns.
struct Row {
  std::int64_t index = 0;
  std::vector<Cell> cells;
};

}  // namespace hexcal
