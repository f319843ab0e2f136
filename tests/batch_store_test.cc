// SPDX-License-Identifier: BSD-3-Clause
#include "batch/store.h"

#include <gtest/gtest.h>

#include "batch/chunk_files.h"
#include "batch/csv.h"
#include "batch/write_csv.h"
#include "config/input_error.h"
#include "testing/batch_jobs.h"
#include "testing/temporary_folder.h"

namespace hexcal {
namespace {

using testing::TemporaryFolder;
using testing::ToyBatch;

std::vector<Row> RowsOf(const Batch& batch, std::int64_t task) {
  std::vector<Row> rows;
  std::int64_t index = task * batch.job->outcomes_per_task();
  for (const Outcome& outcome : batch.job->Work(task))
    rows.push_back(MakeRow(index++, outcome, AllColumns(*batch.job)));
  return rows;
}

using Tasks = std::vector<std::int64_t>;

TEST(PlainText, NeedsNoQuotesAndIsNoFormula) {
  EXPECT_EQ(PlainText(" a, \"b\"\n\tc "), "a; 'b'  c");
  for (const char* formula : {"=1+1", "+1", "-1", "@x", "#x"})
    EXPECT_EQ(PlainText(formula), std::string("'") + formula);
  EXPECT_EQ(PlainText("caf\xc3\xa9"), "caf\xc3\xa9");
  EXPECT_EQ(PlainText("caf\xe9"), "caf?");
  EXPECT_LE(PlainText(std::string(10000, 'x')).size(), 310u);
  EXPECT_EQ(PlainText(""), "");
  EXPECT_EQ(PlainText("   "), "");
}

TEST(Store, KnowsWhatIsMissing) {
  const TemporaryFolder folder;
  const Batch batch = ToyBatch(10);
  Store store(folder.Path("db"), batch);
  EXPECT_EQ(store.Missing({2, 5}), (Tasks{2, 3, 4}));
  for (const std::int64_t task : {9, 3, 0}) store.Insert(RowsOf(batch, task));
  EXPECT_EQ(store.Missing({0, 10}), (Tasks{1, 2, 4, 5, 6, 7, 8}));
  EXPECT_EQ(store.Missing({3, 4}), Tasks());
  EXPECT_EQ(store.Count(), 9);
}

TEST(Store, TakesARowOnce) {
  const TemporaryFolder folder;
  const Batch batch = ToyBatch(10);
  Store store(folder.Path("db"), batch);
  store.Insert(RowsOf(batch, 4));
  std::vector<Row> again = RowsOf(batch, 4);
  again[0].cells[0] = std::string("another");
  store.Insert(again);
  EXPECT_EQ(store.Count(), 3);
  Row row;
  ASSERT_TRUE(store.Find(12, &row));
  EXPECT_EQ(row.cells, RowsOf(batch, 4)[0].cells);
  EXPECT_FALSE(store.Find(11, &row));
}

TEST(Store, GivesAllBitsBackInOrder) {
  const TemporaryFolder folder;
  const Batch batch = ToyBatch(50);
  {
    Store store(folder.Path("db"), batch);
    for (std::int64_t task = 49; task >= 0; --task) store.Insert(RowsOf(batch, task));
  }
  Store store(folder.Path("db"), batch);
  std::int64_t next = 0;
  store.ForEach([&](const Row& row) {
    EXPECT_EQ(row.index, next);
    EXPECT_EQ(row.cells, RowsOf(batch, next / 3)[next % 3].cells) << next;
    ++next;
  });
  EXPECT_EQ(next, 150);
}

TEST(Store, RemovesWholeTasksThatFailed) {
  const TemporaryFolder folder;
  const Batch batch = ToyBatch(10);
  Store store(folder.Path("db"), batch);
  for (std::int64_t task = 0; task < 10; ++task) store.Insert(RowsOf(batch, task));
  EXPECT_EQ(store.Count(RowStatus::kFailed), 1);
  EXPECT_EQ(store.Messages(RowStatus::kFailed, 5), std::vector<std::string>{"no luck"});
  store.Remove(RowStatus::kFailed);
  EXPECT_EQ(store.Missing({0, 10}), Tasks{3});
}

TEST(Store, RefusesResultsOfAnotherBatch) {
  const TemporaryFolder folder;
  { Store store(folder.Path("db"), ToyBatch(10)); }
  EXPECT_NO_THROW(Store(folder.Path("db"), ToyBatch(10)));
  EXPECT_THROW(Store(folder.Path("db"), ToyBatch(10, "other")), InputError);
  Batch renamed = ToyBatch(10);
  renamed.name = "other";
  EXPECT_THROW(Store(folder.Path("db"), renamed), InputError);
  EXPECT_THROW(Store(folder.Write("text", "# not a database, but a text of many letters"), renamed),
               InputError);
}

// An interrupted share leaves part of a chunk; the next run adds the rest, and does not do again
// what a store has.
TEST(ChunkFiles, APartIsCompletedLater) {
  const TemporaryFolder folder;
  const Batch batch = ToyBatch(640);  // chunks of ten tasks
  const ChunkFiles files(folder.Path("."), batch);
  EXPECT_FALSE(files.AreThere());
  ChunkFileSink sink(batch, &files, nullptr);
  EXPECT_EQ(sink.Missing(2).size(), 10u);
  std::vector<Row> part = RowsOf(batch, 20);
  for (const Row& row : RowsOf(batch, 21)) part.push_back(row);
  sink.Take(2, part, false);
  EXPECT_EQ(sink.Missing(2), (Tasks{22, 23, 24, 25, 26, 27, 28, 29}));
  EXPECT_EQ(sink.Missing(3).size(), 10u);
  Store store(folder.Path("db"), batch);
  store.Insert(RowsOf(batch, 29));
  ChunkFileSink with_store(batch, &files, &store);
  EXPECT_EQ(with_store.Missing(2), (Tasks{22, 23, 24, 25, 26, 27, 28}));
  for (const std::int64_t task : with_store.Missing(2))
    with_store.Take(2, RowsOf(batch, task), true);
  EXPECT_EQ(files.Present(), std::vector<std::int64_t>{2});
  EXPECT_EQ(files.Read(2).size(), 27u);

  const Merged merged = MergeChunks(files, &store);
  EXPECT_EQ(merged.rows, 27);
  EXPECT_EQ(merged.duplicates, 0);
  EXPECT_EQ(MergeChunks(files, &store).duplicates, 27);
  for (std::int64_t task = 20; task < 30; ++task)
    for (const Row& expected : RowsOf(batch, task)) {
      Row row;
      ASSERT_TRUE(store.Find(expected.index, &row));
      EXPECT_EQ(row.cells, expected.cells) << expected.index;
    }
  files.RemoveAll();
  EXPECT_FALSE(files.AreThere());
}

TEST(WriteCsv, IsTheSameHoweverTheRowsCame) {
  const TemporaryFolder folder;
  constexpr int kTasks = 600;  // several pieces for each of three connections, and a part of one
  const Batch batch = ToyBatch(kTasks);
  Store forward(folder.Path("f"), batch), backward(folder.Path("b"), batch);
  std::string expected = "study,idx,status,message,count,x,note\n";
  for (std::int64_t task = 0; task < kTasks; ++task) {
    forward.Insert(RowsOf(batch, task));
    backward.Insert(RowsOf(batch, kTasks - 1 - task));
    for (const Row& row : RowsOf(batch, task)) expected += CsvLine("toy", row);
  }
  WriteCsv(folder.Path("f.csv"), batch, {&forward});
  Store second(folder.Path("b"), batch, Database::Access::kRead);
  Store third(folder.Path("b"), batch, Database::Access::kRead);
  WriteCsv(folder.Path("b.csv"), batch, {&backward, &second, &third});
  EXPECT_EQ(folder.Read("f.csv"), expected);
  EXPECT_EQ(folder.Read("b.csv"), expected);
  EXPECT_NE(expected.find("\ntoy,11,failed,no luck,,,\n"), std::string::npos);
}

}  // namespace
}  // namespace hexcal
