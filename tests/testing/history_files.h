// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>
#include <sqlite3.h>

#include <string>
#include <vector>

#include "report/history/check.h"
#include "testing/histories.h"
#include "testing/temporary_folder.h"

namespace hexcal::testing {

// A second program at the file, which knows nothing of hexcal.
class Intruder {
 public:
  explicit Intruder(const std::string& path) {
    EXPECT_EQ(sqlite3_open(path.c_str(), &handle_), SQLITE_OK);
    Try("PRAGMA synchronous = OFF; PRAGMA journal_mode = MEMORY");
  }
  ~Intruder() { sqlite3_close(handle_); }

  int Try(const std::string& sql) {
    return sqlite3_exec(handle_, sql.c_str(), nullptr, nullptr, nullptr);
  }

  // With the triggers out of the way, and put back as they were.
  int TryWithoutTriggers(const std::string& sql) {
    std::vector<std::string> names, statements;
    sqlite3_stmt* select = nullptr;
    sqlite3_prepare_v2(handle_,
                       "SELECT name, sql FROM sqlite_master WHERE type = 'trigger' ORDER BY rowid",
                       -1,
                       &select,
                       nullptr);
    while (sqlite3_step(select) == SQLITE_ROW) {
      names.push_back(reinterpret_cast<const char*>(sqlite3_column_text(select, 0)));
      statements.push_back(reinterpret_cast<const char*>(sqlite3_column_text(select, 1)));
    }
    sqlite3_finalize(select);
    EXPECT_EQ(names.size(), 3u);
    for (const std::string& name : names) EXPECT_EQ(Try("DROP TRIGGER " + name), SQLITE_OK);
    const int result = Try(sql);
    for (const std::string& statement : statements) EXPECT_EQ(Try(statement), SQLITE_OK);
    return result;
  }

 private:
  sqlite3* handle_ = nullptr;
};

// As SQL takes any bytes for a text.
inline std::string QuotedSql(const std::string& bytes) {
  static constexpr char kDigits[] = "0123456789abcdef";
  std::string hex = "CAST(x'";
  for (const unsigned char c : bytes) hex += {kDigits[c / 16], kDigits[c % 16]};
  return hex + "' AS TEXT)";
}

inline HistoryCheck Check(const std::string& path, const std::string& head = {}) {
  return CheckHistory(ReadHistory(path), head);
}

// A history of so many records, of two datasets in turn.
inline std::string MakeHistory(const TemporaryFolder& folder, int records) {
  const std::string path = folder.Path("h.sqlite");
  for (int i = 0; i < records; ++i) Append(path, AnyRecord(i % 2 == 0 ? "even" : "odd", i));
  return path;
}

}  // namespace hexcal::testing
