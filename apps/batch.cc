// SPDX-License-Identifier: BSD-3-Clause
#include "apps/batch.h"

#include <fmt/format.h>

#include <chrono>
#include <filesystem>

#include "apps/batch_manifest.h"
#include "apps/exit_status.h"
#include "apps/flags.h"
#include "apps/in_order.h"
#include "apps/interrupt.h"
#include "apps/message.h"
#include "apps/output_folder.h"
#include "apps/progress.h"
#include "apps/record_of.h"
#include "batch/folder_lock.h"
#include "batch/run_chunks.h"
#include "batch/store.h"
#include "batch/write_csv.h"
#include "config/atomic_file.h"

namespace hexcal {
namespace {

constexpr std::string_view kResultsMark = "study,idx,status,message";
constexpr int kMostMessages = 10;

// Straight into the store, a chunk a transaction.
class StoreSink : public ChunkSink {
 public:
  StoreSink(const Chunks& chunks, Store* store) : chunks_(chunks), store_(store) {}
  std::vector<std::int64_t> Missing(std::int64_t chunk) override {
    return store_->Missing(chunks_[chunk]);
  }
  void Take(std::int64_t, const std::vector<Row>& rows, bool) override { store_->Insert(rows); }

 private:
  Chunks chunks_;
  Store* store_;
};

class BatchRun {
 public:
  explicit BatchRun(const std::string& path)
      : path_(path),
        manifest_(ReadManifest(path)),
        folder_(FLAGS_out,
                "",
                {{"results.csv", std::string(kResultsMark)}, {"run.json", std::string(kRunMark)}},
                {path},
                FLAGS_force) {
    MakeFolder(folder_.path());
  }

  int Run() {
    const auto start = std::chrono::steady_clock::now();
    const PatientWork patient;
    const FolderLock lock(folder_.path(), FolderLock::Kind::kAlone);
    if (!lock.IsHeld())
      throw OutputError(folder_.path() + ": another hexcal batch is at work in this folder");
    RemoveLeftTemporaries(folder_.path());
    const std::unique_ptr<Store> store = OpenStore();
    if (!Work(store.get())) return kInterrupted;
    WriteCsv(folder_.PathOf("results.csv"), manifest_.batch, store.get());
    const double seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    folder_.Write(
        "run.json",
        RunJson(RecordOf(
            "batch", std::vector<std::string>{path_}, seconds, ThreadsFor(FLAGS_threads))));
    return Report(store.get());
  }

 private:
  // With --force what is there of another batch, or of another program, makes way.
  std::unique_ptr<Store> OpenStore() const {
    const std::string path = folder_.PathOf("results.sqlite");
    std::unique_ptr<Store> store;
    try {
      store = std::make_unique<Store>(path, manifest_.batch);
    } catch (const InputError&) {
      if (!FLAGS_force) throw;
      for (const char* end : {"", "-journal", "-wal", "-shm"}) std::filesystem::remove(path + end);
      store = std::make_unique<Store>(path, manifest_.batch);
    }
    if (FLAGS_retry) store->Remove(RowStatus::kFailed);
    return store;
  }

  bool Work(Store* store) const {
    Progress progress(manifest_.batch.name, FLAGS_quiet);
    RunOptions options;
    options.threads = ThreadsFor(FLAGS_threads);
    options.stop = &PatientWork::IsInterrupted;
    options.progress = [&progress](std::int64_t done, std::int64_t of) {
      progress.Update(done, of);
    };
    StoreSink sink(Chunks(*manifest_.batch.job), store);
    if (RunChunks(manifest_.batch, options, &sink)) return true;
    PrintError(
        fmt::format("interrupted: {} of {} rows of results are kept; the same command goes on",
                    store->Count(),
                    manifest_.batch.rows()));
    return false;
  }

  int Report(Store* store) const {
    const std::int64_t failed = store->Count(RowStatus::kFailed);
    const std::int64_t untrusted = store->Count(RowStatus::kUntrusted);
    if (failed > 0) PrintFailures(store, failed);
    if (!FLAGS_quiet) Print(store->Count(), untrusted, failed);
    if (failed > 0) return kSomeFailed;
    return untrusted > 0 && !manifest_.is_study ? kNotTrusted : kDone;
  }

  void PrintFailures(Store* store, std::int64_t failed) const {
    for (const std::string& message : store->Messages(RowStatus::kFailed, kMostMessages))
      PrintError(message);
    const std::string more = failed > kMostMessages ? ", the others are in results.csv" : "";
    PrintError(fmt::format("{} of {} failed{}", failed, manifest_.batch.rows(), more));
  }

  void Print(std::int64_t rows, std::int64_t untrusted, std::int64_t failed) const {
    Progress::ClearVisible();
    if (FLAGS_json)
      fmt::print(
          R"({{"format": "hexcal/batch-summary/1", "name": "{}", "rows": {}, "untrusted": {}, "failed": {}}})"
          "\n",
          manifest_.batch.name,
          rows,
          untrusted,
          failed);
    else
      fmt::print(
          "{}\n  done           {}\n  untrusted      {}\n  failed         {}\n  written to     "
          "{}\n",
          manifest_.batch.name,
          rows - untrusted - failed,
          untrusted,
          failed,
          folder_.path());
  }

  std::string path_;
  Manifest manifest_;
  OutputFolder folder_;
};

int RunBatch(const std::vector<std::string>& files) { return BatchRun(files[0]).Run(); }

}  // namespace

Command BatchCommand() {
  return {
      "batch",
      "many datasets, by one manifest",
      "MANIFEST",
      1,
      1,
      "Calibrates every dataset that the manifest names (docs/batch.md), or looks for what is "
      "missing in its model, and writes a row of results of each to results.csv and "
      "results.sqlite in DIR. A bad dataset does not keep the others from being done (exit status "
      "6). Interrupted or killed, it keeps what was finished; the same command does the rest. "
      "The results do not depend on the number of threads.",
      {{"out", true, "DIR", "The results go to DIR."},
       {"retry"},
       {"config"},
       {"threads"},
       {"json", false, {}, "Print the counts as JSON instead."},
       {"quiet"},
       {"force",
        false,
        {},
        "Replace files that hexcal did not write, and results of another manifest."}},
      &RunBatch,
  };
}

}  // namespace hexcal
