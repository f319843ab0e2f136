// SPDX-License-Identifier: BSD-3-Clause
#include "report/history/check.h"

#include <fmt/format.h>

namespace hexcal {
namespace {

// What is wrong with a row by itself.
std::vector<std::string> ProblemsOf(const StoredRecord& row) {
  std::vector<std::string> problems;
  if (!row.has_right_types) problems.push_back("a column is not of the type that hexcal writes");
  if (Sha256(row.text) != row.hash)
    problems.push_back("its text or its hash was changed: they do not belong together");
  if (!row.record) {
    problems.push_back("its text is not that of a record");
    return problems;
  }
  const HistoryRecord& record = *row.record;
  if (CanonicalText(record) != row.text)
    problems.push_back("its text is not written as hexcal writes it");
  if (record.number != row.number)
    problems.push_back(
        fmt::format("its column number is {}, its text says {}", row.number, record.number));
  if (record.previous != row.previous)
    problems.push_back("its column previous is not what its text says");
  const auto expected = RepeatedOf(record);
  for (std::size_t i = 0; i < kRepeated.size(); ++i)
    if (expected[i] != row.repeated[i])
      problems.push_back(fmt::format("its column {} is not what its text says", kRepeated[i]));
  return problems;
}

}  // namespace

HistoryCheck CheckHistory(const std::vector<StoredRecord>& rows, const std::string& head) {
  HistoryCheck check;
  check.head = kNoHash;
  long expected = 1;
  bool has_head = head.empty();
  for (const StoredRecord& row : rows) {
    for (std::string& what : ProblemsOf(row)) check.problems.push_back({row.number, what});
    if (row.number != expected)
      check.problems.push_back(
          {row.number, fmt::format("found where record {} should be", expected)});
    if (row.previous != check.head)
      check.problems.push_back({row.number,
                                "does not follow the record before it: one of the two was changed, "
                                "or records were removed, inserted or reordered"});
    if (has_head && !head.empty()) ++check.after_head;
    has_head = has_head || row.hash == head;
    check.head = row.hash;
    expected = row.number + 1;
  }
  if (!has_head)
    check.problems.push_back({0,
                              fmt::format("no record has the hash {}: the end was cut off, records "
                                          "were written anew, or it is of another history",
                                          head)});
  return check;
}

}  // namespace hexcal
