// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "report/history/record.h"

namespace hexcal {

// The file of a history (docs/history.md): one table, a row a calibration, each row's hash being of
// its text, which holds the hash of the row before.

// The columns beside number, previous, hash and text, for other programs' queries: they repeat what
// the text says.
inline constexpr std::array<std::string_view, 6> kRepeated = {
    "written", "dataset", "command", "user", "host", "operator"};
std::array<std::string, 6> RepeatedOf(const HistoryRecord& record);

// A row as it stands in the file, whatever somebody did to it.
struct StoredRecord {
  long number = 0;
  std::string previous, hash, text;
  std::array<std::string, 6> repeated;
  bool has_right_types = true;          // an integer, and texts
  std::optional<HistoryRecord> record;  // what the text says; nothing where it is none
};

// All rows by number. InputError for a file that is not there, no history, of a later version,
// damaged, or whose table or triggers are not those that hexcal makes.
std::vector<StoredRecord> ReadHistory(const std::string& path);

// Looks, before anything is computed, whether a calibration could be appended, and makes nothing:
// InputError for a file that ReadHistory refuses or whose last record is not as it was written,
// OutputError where the file cannot be made or written.
void RequireAppendable(const std::string& path);

// A record on its way into the file, which no other process can append to meanwhile: the record's
// hash can be printed in reports before the record is there.
class PendingRecord {
 public:
  // Makes the file where there is none (or an empty one). number and previous of the record are
  // filled in. Errors as RequireAppendable, or OutputError where another process holds the file
  // for longer than a minute.
  PendingRecord(const std::string& path, HistoryRecord record);
  ~PendingRecord();  // without Commit: nothing was appended
  PendingRecord(const PendingRecord&) = delete;
  PendingRecord& operator=(const PendingRecord&) = delete;

  const HistoryRecord& record() const { return record_; }
  const std::string& hash() const { return hash_; }

  // The last records of its dataset that are in the file, at most so many, the oldest first.
  std::vector<StoredRecord> Before(std::size_t at_most) const;

  // On the disk when it returns.
  void Commit();

 private:
  struct File;
  std::unique_ptr<File> file_;
  HistoryRecord record_;
  std::string text_, hash_;
};

}  // namespace hexcal
