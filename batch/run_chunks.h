// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "batch/job.h"

namespace hexcal {

// Of the chunks, the part that one of `count` workers does: those numbers that leave `index` when
// divided by count.
struct Share {
  int index = 0;
  int count = 1;

  // Numbers below chunks that are of this share.
  std::int64_t Size(std::int64_t chunks) const {
    return chunks > index ? (chunks - index + count - 1) / count : 0;
  }
};

struct RunOptions {
  int threads = 1;
  Share share;
  std::function<bool()> stop = [] { return false; };  // asked before each task, from any thread
  std::function<void(std::int64_t done, std::int64_t of)> progress;  // chunks; from the caller's
};

// Where results go. Called from one thread at a time.
class ChunkSink {
 public:
  virtual ~ChunkSink() = default;
  // The tasks of the chunk that are to be done.
  virtual std::vector<std::int64_t> Missing(std::int64_t chunk) = 0;
  // Rows of whole tasks in the order of their indices; is_whole: all that were missing.
  virtual void Take(std::int64_t chunk, const std::vector<Row>& rows, bool is_whole) = 0;
};

// Works on what is missing in the chunks of the share, a chunk a thread, a task one thread. False:
// stopped before all was done; what was done is in the sink. At most `threads` chunks of rows are
// in memory. The first exception of a sink or task ends the run and comes out.
bool RunChunks(const Batch& batch, const RunOptions& options, ChunkSink* sink);

}  // namespace hexcal
