// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "batch/csv.h"
#include "batch/job.h"
#include "config/database.h"

namespace hexcal {

inline constexpr std::string_view kStoreMark = "hxcb";  // in the file's first bytes

// The results of one batch in an SQLite file: table `results`, unique in (study, idx), and table
// `batch`, whose one row says what they are of. For one thread at a time.
class Store {
 public:
  // Makes the file where there is none, if it may write. InputError for a file that is not of
  // hexcal batch, and for the results of another batch.
  Store(const std::string& path,
        const Batch& batch,
        Database::Access access = Database::Access::kWrite);
  ~Store();

  // The tasks of this range that have no results yet.
  std::vector<std::int64_t> Missing(const Chunks::Range& tasks);
  // All of them or none; those that are there stay.
  void Insert(const std::vector<Row>& rows);
  // The row, cells of all columns; nothing where it is not there.
  bool Find(std::int64_t index, Row* row);

  std::int64_t Count();  // rows
  std::int64_t Count(RowStatus status);
  std::vector<std::string> Messages(RowStatus status, int at_most);
  void Remove(RowStatus status);  // to be worked on again, with all rows of the same task
  // In the order of their indices.
  void ForEach(std::int64_t first, std::int64_t end, const std::function<void(const Row&)>& use);
  void ForEach(const std::function<void(const Row&)>& use) { ForEach(0, INT64_MAX, use); }

 private:
  void Describe(const Batch& batch);
  void RequireSameBatch();
  Row Read(const Statement& statement) const;

  std::string study_, digest_;
  int rows_per_task_;
  std::vector<Column> columns_;
  std::unique_ptr<Database> database_;
  std::unique_ptr<Statement> insert_, select_;
};

}  // namespace hexcal
