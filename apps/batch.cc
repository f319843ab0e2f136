// SPDX-License-Identifier: BSD-3-Clause
#include "apps/batch.h"

#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <future>
#include <memory>

#include "apps/batch_manifest.h"
#include "apps/batch_report.h"
#include "apps/batch_share.h"
#include "apps/exit_status.h"
#include "apps/flags.h"
#include "apps/in_order.h"
#include "apps/interrupt.h"
#include "apps/message.h"
#include "apps/output_folder.h"
#include "apps/progress.h"
#include "apps/record_of.h"
#include "apps/usage_error.h"
#include "batch/chunk_files.h"
#include "batch/folder_lock.h"
#include "batch/run_chunks.h"
#include "batch/store.h"
#include "batch/study_summary.h"
#include "batch/write_csv.h"
#include "config/atomic_file.h"

namespace hexcal {
namespace {

constexpr std::string_view kResultsMark = "study,idx,status,message";
constexpr std::string_view kSummaryMark = "study,scenario,noise,poses";
constexpr int kMostGaps = 5;  // named in a message

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

std::vector<OutputFile> OutputsOf(const Manifest& manifest) {
  std::vector<OutputFile> files = {{"results.csv", std::string(kResultsMark)},
                                   {"run.json", std::string(kRunMark)}};
  if (manifest.study != nullptr) files.push_back({"summary.csv", std::string(kSummaryMark)});
  return files;
}

class BatchRun {
 public:
  explicit BatchRun(const std::string& path)
      : path_(path),
        manifest_(ReadManifest(path)),
        chunks_(*manifest_.batch.job),
        folder_(FLAGS_out, "", OutputsOf(manifest_), {path}, FLAGS_force),
        files_(folder_.path(), manifest_.batch),
        store_path_(folder_.PathOf("results.sqlite")) {
    MakeFolder(folder_.path());
  }

  int RunAlone() {
    const FolderLock lock(folder_.path(), FolderLock::Kind::kAlone);
    if (!lock.IsHeld())
      throw OutputError(folder_.path() + ": another hexcal batch is at work in this folder");
    const std::unique_ptr<Store> store = OpenStore();
    Merge(store.get());
    if (FLAGS_merge) RefuseGaps(store.get());
    StoreSink sink(chunks_, store.get());
    if (!Work({}, ThreadsFor(FLAGS_threads), &sink)) {
      PrintError(
          fmt::format("interrupted: {} of {} rows of results are kept; the same command "
                      "does the rest",
                      store->Count(),
                      manifest_.batch.rows()));
      return kInterrupted;
    }
    return Finish(store.get());
  }

  // Other processes do the other shares at the same time, or at another. The last of several ranks
  // merges; a failed task is the merge's affair, for an engine stops all when one of them fails.
  int RunShare(const ShareOfRun& share) {
    {
      const FolderLock lock(folder_.path(), FolderLock::Kind::kShared);
      const std::unique_ptr<Store> store = StoreIfThere();
      ChunkFileSink sink(manifest_.batch, &files_, store.get());
      if (!Work(share.share, std::max(1, FLAGS_threads), &sink)) {
        PrintError("interrupted: what was finished is kept; the same command does the rest");
        return kInterrupted;
      }
    }
    if (!share.is_rank) return kDone;
    const FolderLock lock(folder_.path(), FolderLock::Kind::kAlone);
    if (!lock.IsHeld() || !IsComplete()) return kDone;
    if (!files_.AreThere() && share.share.index > 0) return kDone;  // all was there before
    const std::unique_ptr<Store> store = OpenStore();
    Merge(store.get());
    return Finish(store.get());
  }

 private:
  // With --force what is there of another batch, or of another program, makes way.
  std::unique_ptr<Store> OpenStore() const {
    RemoveLeftTemporaries(folder_.path());
    std::unique_ptr<Store> store;
    try {
      store = std::make_unique<Store>(store_path_, manifest_.batch);
    } catch (const InputError&) {
      if (!FLAGS_force) throw;
      for (const char* end : {"", "-journal", "-wal", "-shm"})
        std::filesystem::remove(store_path_ + end);
      store = std::make_unique<Store>(store_path_, manifest_.batch);
    }
    if (FLAGS_retry) store->Remove(RowStatus::kFailed);
    return store;
  }

  std::unique_ptr<Store> StoreIfThere() const {
    if (!std::filesystem::exists(store_path_)) return nullptr;
    return std::make_unique<Store>(store_path_, manifest_.batch);
  }

  // What shares of this batch have left.
  void Merge(Store* store) const {
    try {
      const Merged merged = MergeChunks(files_, store);
      if (FLAGS_merge && merged.duplicates > 0)
        PrintWarning(fmt::format("{} rows of chunks were in results.sqlite already, alike",
                                 merged.duplicates));
    } catch (const InputError&) {
      if (!FLAGS_force) throw;
      files_.RemoveAll();
    }
  }

  bool IsComplete() const {
    const std::unique_ptr<Store> store = StoreIfThere();
    ChunkFileSink sink(manifest_.batch, &files_, store.get());
    for (std::int64_t chunk = 0; chunk < chunks_.count(); ++chunk)
      if (!sink.Missing(chunk).empty()) return false;
    return true;
  }

  void RefuseGaps(Store* store) const {
    std::int64_t missing = 0;
    std::string gaps;
    int named = 0;
    for (std::int64_t chunk = 0; chunk < chunks_.count(); ++chunk) {
      const std::size_t size = store->Missing(chunks_[chunk]).size();
      missing += static_cast<std::int64_t>(size);
      if (size > 0 && ++named <= kMostGaps) gaps += fmt::format(" {}", chunk);
    }
    if (missing == 0) return;
    throw InputError(FileLocation(folder_.path()),
                     fmt::format("no results of {} of {} tasks (chunks{}{})",
                                 missing,
                                 manifest_.batch.job->tasks(),
                                 gaps,
                                 named > kMostGaps ? " and others" : ""),
                     "those of all shares: the shares that are missing, or hexcal batch without "
                     "--merge, do the rest");
  }

  bool Work(const Share& share, int threads, ChunkSink* sink) const {
    Progress progress(manifest_.batch.name, FLAGS_quiet || share.index > 0);
    RunOptions options;
    options.threads = threads;
    options.share = share;
    options.stop = &PatientWork::IsInterrupted;
    options.progress = [&progress](std::int64_t done, std::int64_t of) {
      progress.Update(done, of);
    };
    return RunChunks(manifest_.batch, options, sink);
  }

  void WriteResults(int threads, Store* store) const {
    std::vector<std::unique_ptr<Store>> others;
    std::vector<Store*> stores = {store};
    for (int i = 1; i < threads; ++i) {
      others.push_back(
          std::make_unique<Store>(store_path_, manifest_.batch, Database::Access::kRead));
      stores.push_back(others.back().get());
    }
    WriteCsv(folder_.PathOf("results.csv"), manifest_.batch, stores);
  }

  // Of a study; else empty. By a connection of its own, for it runs beside WriteResults.
  std::vector<StudySummary> Summaries() const {
    if (manifest_.study == nullptr) return {};
    Store store(store_path_, manifest_.batch, Database::Access::kRead);
    return Summarise(manifest_.study->study(), &store);
  }

  int Finish(Store* store) {
    const int threads = ThreadsFor(FLAGS_threads);
    std::future<std::vector<StudySummary>> summarised = std::async(
        threads > 1 ? std::launch::async : std::launch::deferred, [this] { return Summaries(); });
    WriteResults(threads, store);
    const std::vector<StudySummary> summaries = summarised.get();
    std::vector<std::pair<std::string, std::string>> files;
    if (manifest_.study != nullptr)
      files.emplace_back("summary.csv", SummaryCsv(manifest_.batch.name, summaries));
    const double seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    files.emplace_back(
        "run.json",
        RunJson(RecordOf(
            "batch", std::vector<std::string>{path_}, seconds, ThreadsFor(FLAGS_threads))));
    folder_.Write(files);
    files_.RemoveAll();
    return ReportBatch(manifest_, summaries, folder_.path(), store);
  }

  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::string path_;
  Manifest manifest_;
  Chunks chunks_;
  OutputFolder folder_;
  ChunkFiles files_;
  std::string store_path_;
};

void RefuseTogether(bool is_share) {
  if (FLAGS_merge && !FLAGS_task.empty())
    throw UsageError("batch: --merge does not go with --task");
  if (is_share && (FLAGS_retry || FLAGS_force))
    throw UsageError(
        "batch: --retry and --force would undo what other shares do; run them without --task and "
        "mpirun");
}

int RunBatch(const std::vector<std::string>& files) {
  const std::optional<ShareOfRun> share =
      FLAGS_merge ? std::nullopt : ShareOfThisProcess(FLAGS_task);
  RefuseTogether(share.has_value());
  const PatientWork patient;
  BatchRun run(files[0]);
  return share ? run.RunShare(*share) : run.RunAlone();
}

}  // namespace

Command BatchCommand() {
  return {
      "batch",
      "many datasets, or a Monte Carlo study",
      "MANIFEST",
      1,
      1,
      "Calibrates every dataset that the manifest names (docs/batch.md), or looks for what is "
      "missing in its model, and writes a row of results of each to results.csv and "
      "results.sqlite in DIR. Or it draws datasets from a truth, gives them to several estimators "
      "and says in summary.csv how accurate these are and how often their intervals hold the "
      "truth. "
      "A bad dataset does not keep the others from being done (exit status "
      "6). Interrupted or killed, it keeps what was finished; the same command does the rest. "
      "Under mpirun, each process does a share and the last merges; --task and --merge are for "
      "the job arrays of Slurm and the like. The results depend on none of this.",
      {{"out", true, "DIR", "The results go to DIR."},
       {"task"},
       {"merge"},
       {"retry"},
       {"config"},
       {"threads", false, {}, "Tasks at once; a share does one after another without it."},
       {"json", false, {}, "Print the counts as JSON instead."},
       {"quiet"},
       {"force",
        false,
        {},
        "Replace files that hexcal did not write, and results of another manifest."}},
      &RunBatch,
      {{"hexcal batch examples/batch/datasets.yaml --out=out/batch",
        "Three datasets, a row of results.csv each."}},
  };
}

}  // namespace hexcal
