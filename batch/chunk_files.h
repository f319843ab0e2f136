// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "batch/run_chunks.h"
#include "batch/store.h"

namespace hexcal {

// DIR/chunks/000012.csv and so on: results of processes that may not write to one database at the
// same time. Each file is written whole, by whoever did its tasks, and says of which batch it is.
class ChunkFiles {
 public:
  ChunkFiles(const std::string& folder, const Batch& batch);

  bool AreThere() const;                      // any, of whatever batch
  std::vector<std::int64_t> Present() const;  // numbers of chunks, ascending
  // Nothing where the file is not there. InputError for one of another batch, and for one that is
  // not as it was written.
  std::vector<Row> Read(std::int64_t chunk) const;
  void Write(std::int64_t chunk, const std::vector<Row>& rows) const;
  void RemoveAll() const;  // the folder too

  std::string PathOf(std::int64_t chunk) const;

 private:
  std::string HeadOf(std::int64_t chunk) const;
  Row ParseRow(const std::string& path, int line_number, const std::string& line) const;

  std::string folder_;
  const Batch& batch_;
  std::vector<Column> columns_;
};

// Into chunk files. What a store of an earlier merge has is not done again.
class ChunkFileSink : public ChunkSink {
 public:
  ChunkFileSink(const Batch& batch, const ChunkFiles* files, Store* store_or_null)
      : chunks_(*batch.job),
        rows_per_task_(batch.job->outcomes_per_task()),
        files_(files),
        store_(store_or_null) {}
  std::vector<std::int64_t> Missing(std::int64_t chunk) override;
  void Take(std::int64_t chunk, const std::vector<Row>& rows, bool is_whole) override;

 private:
  Chunks chunks_;
  int rows_per_task_;
  const ChunkFiles* files_;
  Store* store_;
};

// What a merge found.
struct Merged {
  std::int64_t rows = 0;        // new in the store
  std::int64_t duplicates = 0;  // that were there already, alike
};

// All rows of the files into the store, a file a transaction. InputError where a row differs from
// the one that is there.
Merged MergeChunks(const ChunkFiles& files, Store* store);

}  // namespace hexcal
