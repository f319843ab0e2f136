// SPDX-License-Identifier: BSD-3-Clause
#include "apps/batch_report.h"

#include <fmt/format.h>

#include "apps/exit_status.h"
#include "apps/flags.h"
#include "apps/message.h"
#include "apps/progress.h"

namespace hexcal {
namespace {

constexpr int kMostMessages = 10;

void PrintFailures(Store* store, std::int64_t failed, std::int64_t rows) {
  for (const std::string& message : store->Messages(RowStatus::kFailed, kMostMessages))
    PrintError(message);
  const std::string more = failed > kMostMessages ? ", the others are in results.csv" : "";
  PrintError(fmt::format("{} of {} failed{}", failed, rows, more));
}

void PrintCounts(const std::string& name,
                 const std::string& folder,
                 std::int64_t rows,
                 std::int64_t untrusted,
                 std::int64_t failed) {
  Progress::ClearVisible();
  if (FLAGS_json)
    fmt::print(R"({{"format": "hexcal/batch-counts/1", "name": "{}", "rows": {}, )"
               R"("untrusted": {}, "failed": {}}})"
               "\n",
               name,
               rows,
               untrusted,
               failed);
  else
    fmt::print("{}\n  done           {}\n  untrusted      {}\n  failed         {}\n",
               name,
               rows - untrusted - failed,
               untrusted,
               failed);
  if (!FLAGS_json) fmt::print("  written to     {}\n", folder);
}

void PrintStudy(const std::string& name,
                const std::vector<StudySummary>& summaries,
                const std::string& folder) {
  Progress::ClearVisible();
  fmt::print("{}\n  written to     {}\n", SummaryTable(name, summaries), folder);
}

}  // namespace

int ReportBatch(const Manifest& manifest,
                const std::vector<StudySummary>& summaries,
                const std::string& folder,
                Store* store) {
  const std::int64_t failed = store->Count(RowStatus::kFailed);
  const std::int64_t untrusted = store->Count(RowStatus::kUntrusted);
  if (failed > 0) PrintFailures(store, failed, manifest.batch.rows());
  if (FLAGS_quiet) {
    // The files have it all.
  } else if (manifest.study != nullptr && !FLAGS_json) {
    PrintStudy(manifest.batch.name, summaries, folder);
  } else {
    PrintCounts(manifest.batch.name, folder, manifest.batch.rows(), untrusted, failed);
  }
  if (failed > 0) return kSomeFailed;
  // Of a study, that some draws are not trusted is a result like others.
  return untrusted > 0 && manifest.study == nullptr ? kNotTrusted : kDone;
}

}  // namespace hexcal
