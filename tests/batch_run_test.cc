// SPDX-License-Identifier: BSD-3-Clause
#include "batch/run_chunks.h"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <stdexcept>

#include "batch/csv.h"
#include "batch/folder_lock.h"
#include "testing/batch_jobs.h"
#include "testing/temporary_folder.h"

namespace hexcal {
namespace {

using testing::ToyBatch;
using testing::ToyOf;

// Keeps rows as lines of CSV.
class Kept : public ChunkSink {
 public:
  explicit Kept(const Batch& batch) : chunks_(*batch.job) {}

  std::vector<std::int64_t> Missing(std::int64_t chunk) override {
    std::vector<std::int64_t> missing;
    for (std::int64_t task = chunks_[chunk].first; task < chunks_[chunk].end; ++task)
      if (lines.count(3 * task) == 0) missing.push_back(task);
    return missing;
  }
  void Take(std::int64_t chunk, const std::vector<Row>& rows, bool is_whole) override {
    if (throws) throw std::runtime_error("full");
    if (is_whole) whole.insert(chunk);
    for (const Row& row : rows) EXPECT_TRUE(lines.emplace(row.index, CsvLine("t", row)).second);
  }

  std::map<std::int64_t, std::string> lines;
  std::set<std::int64_t> whole;
  bool throws = false;

 private:
  Chunks chunks_;
};

TEST(Chunks, CoverAllTasksOnce) {
  for (const std::int64_t tasks : {1, 2, 63, 64, 65, 640, 1000, 9999, 100000}) {
    const testing::ToyJob job(tasks);
    const Chunks chunks(job);
    std::int64_t next = 0;
    for (std::int64_t i = 0; i < chunks.count(); ++i) {
      EXPECT_EQ(chunks[i].first, next);
      EXPECT_GT(chunks[i].end, next);
      EXPECT_LE(3 * (chunks[i].end - next), 100);
      next = chunks[i].end;
    }
    EXPECT_EQ(next, tasks);
    EXPECT_GE(chunks.count(), std::min<std::int64_t>(tasks, 33)) << tasks;
  }
}

TEST(RunChunks, GivesTheSameForAnyNumberOfThreads) {
  const Batch batch = ToyBatch(1000);
  Kept one(batch);
  EXPECT_TRUE(RunChunks(batch, {}, &one));
  EXPECT_EQ(one.lines.size(), 3000u);
  for (const int threads : {2, 4, 13}) {
    Kept some(batch);
    RunOptions options;
    options.threads = threads;
    EXPECT_TRUE(RunChunks(batch, options, &some));
    EXPECT_EQ(some.lines, one.lines);
  }
}

TEST(RunChunks, SharesMakeTheWhole) {
  const Batch batch = ToyBatch(1000);
  Kept one(batch);
  EXPECT_TRUE(RunChunks(batch, {}, &one));
  for (const int count : {2, 3, 4, 200}) {
    Kept together(batch);
    for (int index = 0; index < count; ++index) {
      RunOptions options;
      options.share = {index, count};
      EXPECT_TRUE(RunChunks(batch, options, &together));
    }
    EXPECT_EQ(together.lines, one.lines);  // Take fails for a row that comes twice
  }
}

TEST(RunChunks, KeepsWhatWasFinishedAndDoesTheRestLater) {
  const Batch batch = ToyBatch(1000);
  Kept one(batch), parts(batch);
  EXPECT_TRUE(RunChunks(batch, {}, &one));
  ToyOf(batch).worked = 0;
  for (int stop_at = 111; stop_at < 1000; stop_at += 111) {
    RunOptions options;
    options.threads = 2;
    options.stop = [&] { return ToyOf(batch).worked >= stop_at; };
    EXPECT_FALSE(RunChunks(batch, options, &parts));
    EXPECT_EQ(parts.lines.size(), 3u * ToyOf(batch).worked);
  }
  EXPECT_TRUE(RunChunks(batch, {}, &parts));
  EXPECT_EQ(parts.lines, one.lines);
  EXPECT_EQ(ToyOf(batch).worked, 1000);
  EXPECT_TRUE(RunChunks(batch, {}, &parts));
  EXPECT_EQ(ToyOf(batch).worked, 1000);
}

TEST(RunChunks, EndsWithTheFirstException) {
  const Batch batch = ToyBatch(1000);
  Kept full(batch);
  full.throws = true;
  RunOptions options;
  options.threads = 4;
  EXPECT_THROW(RunChunks(batch, options, &full), std::runtime_error);
  EXPECT_LT(ToyOf(batch).worked, 200);
}

TEST(RunChunks, ReportsHowFarItIs) {
  const Batch batch = ToyBatch(1000);
  Kept kept(batch);
  RunOptions options;
  std::int64_t last = 0;
  options.progress = [&](std::int64_t done, std::int64_t of) {
    EXPECT_GE(done, last);
    EXPECT_EQ(of, Chunks(*batch.job).count());
    last = done;
  };
  EXPECT_TRUE(RunChunks(batch, options, &kept));
  EXPECT_EQ(last, Chunks(*batch.job).count());
}

TEST(FolderLock, OneHasItAloneOrManyShareIt) {
  const testing::TemporaryFolder folder;
  const std::string path = folder.Path("");
  {
    const FolderLock first(path, FolderLock::Kind::kShared),
        second(path, FolderLock::Kind::kShared);
    EXPECT_TRUE(first.IsHeld() && second.IsHeld());
    EXPECT_FALSE(FolderLock(path, FolderLock::Kind::kAlone).IsHeld());
  }
  {
    const FolderLock alone(path, FolderLock::Kind::kAlone);
    EXPECT_TRUE(alone.IsHeld());
    EXPECT_FALSE(FolderLock(path, FolderLock::Kind::kAlone).IsHeld());
  }
  EXPECT_TRUE(FolderLock(path, FolderLock::Kind::kAlone).IsHeld());
  EXPECT_TRUE(folder.Names().empty());
}

}  // namespace
}  // namespace hexcal
