// SPDX-License-Identifier: BSD-3-Clause
#include "batch/run_chunks.h"

#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>

#include "batch/csv.h"

namespace hexcal {
namespace {

constexpr std::chrono::milliseconds kBetweenBars(100);

class Workers {
 public:
  Workers(const Batch& batch, const RunOptions& options, ChunkSink* sink)
      : batch_(batch),
        options_(options),
        sink_(sink),
        chunks_(*batch.job),
        columns_(AllColumns(*batch.job)),
        of_(options.share.Size(chunks_.count())) {}

  bool Run() {
    std::vector<std::thread> threads;
    for (int i = 0; i < options_.threads; ++i) threads.emplace_back([this] { Work(); });
    ShowProgress();
    for (std::thread& thread : threads) thread.join();
    if (error_) std::rethrow_exception(error_);
    return done_ == of_;
  }

 private:
  void ShowProgress() {
    std::unique_lock<std::mutex> lock(mutex_);
    // The end is told even where the work was over before anybody looked.
    for (bool is_over = false; !is_over;) {
      if (working_ > 0) changed_.wait_for(lock, kBetweenBars);
      is_over = working_ == 0;
      const std::int64_t done = done_;
      lock.unlock();
      if (options_.progress) options_.progress(done, of_);
      lock.lock();
    }
  }

  void Work() {
    try {
      while (WorkOnNext()) {
      }
    } catch (...) {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (!error_) error_ = std::current_exception();
    }
    const std::lock_guard<std::mutex> lock(mutex_);
    --working_;
    changed_.notify_all();
  }

  bool WorkOnNext() {
    std::vector<std::int64_t> missing;
    std::int64_t chunk = 0;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (next_ >= of_ || error_ || options_.stop()) return false;
      chunk = options_.share.index + options_.share.count * next_++;
      missing = sink_->Missing(chunk);
    }
    const std::vector<Row> rows = RowsOf(missing);
    const bool is_whole = rows.size() == missing.size() * batch_.job->outcomes_per_task();
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!rows.empty()) sink_->Take(chunk, rows, is_whole);
    if (is_whole) ++done_;
    return is_whole;
  }

  // Up to where the run is stopped.
  std::vector<Row> RowsOf(const std::vector<std::int64_t>& tasks) const {
    std::vector<Row> rows;
    for (const std::int64_t task : tasks) {
      if (options_.stop()) break;
      std::int64_t index = task * batch_.job->outcomes_per_task();
      for (const Outcome& outcome : batch_.job->Work(task))
        rows.push_back(MakeRow(index++, outcome, columns_));
    }
    return rows;
  }

  const Batch& batch_;
  const RunOptions& options_;
  ChunkSink* sink_;
  const Chunks chunks_;
  const std::vector<Column> columns_;
  const std::int64_t of_;

  std::mutex mutex_;
  std::condition_variable changed_;
  int working_ = options_.threads;
  std::int64_t next_ = 0, done_ = 0;
  std::exception_ptr error_;
};

}  // namespace

bool RunChunks(const Batch& batch, const RunOptions& options, ChunkSink* sink) {
  return Workers(batch, options, sink).Run();
}

}  // namespace hexcal
