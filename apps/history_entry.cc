// SPDX-License-Identifier: BSD-3-Clause
#include "apps/history_entry.h"

#include <fmt/format.h>
#include <pwd.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <system_error>

#include "apps/flags.h"
#include "apps/interrupt.h"
#include "apps/message.h"

namespace hexcal {
namespace {

std::string UserName() {
  std::array<char, 16384> buffer;
  passwd entry = {};
  passwd* found = nullptr;
  if (getpwuid_r(getuid(), &entry, buffer.data(), buffer.size(), &found) == 0 && found != nullptr)
    return found->pw_name;
  return fmt::format("uid {}", getuid());
}

}  // namespace

void CheckHistoryFlag() {
  if (FLAGS_history.empty()) return;
  RequireAppendable(FLAGS_history);
  // A slip in the path would begin another history unseen.
  const std::filesystem::path folder = std::filesystem::absolute(FLAGS_history).parent_path();
  std::error_code ignored;
  if (!std::filesystem::exists(folder, ignored))
    PrintWarning(fmt::format(
        "--history={}: its folder is not there yet: a new history begins in it", FLAGS_history));
}

HistoryEntry::HistoryEntry(std::string_view command,
                           const Dataset& dataset,
                           const RunRecord& run,
                           const ResultHeader& header,
                           const Estimate& estimate,
                           const std::vector<Effect>& effects,
                           const std::string& result) {
  if (FLAGS_history.empty()) return;
  try {
    const std::shared_ptr<const std::string>& table = dataset.measurement->where.file;
    HistoryRecord record = MakeHistoryRecord(
        command, table ? *table : dataset.path, run, header, estimate, effects, result);
    record.author = {UserName(), run.host.name, FLAGS_operator};
    pending_ = std::make_unique<PendingRecord>(FLAGS_history, std::move(record));
    log_ = MakeChangeLog(FLAGS_history, *pending_);
  } catch (...) {
    error_ = std::current_exception();
  }
}

std::optional<HistoryMark> HistoryEntry::mark() const {
  return log_ ? std::optional<HistoryMark>(log_->mark) : std::nullopt;
}

void HistoryEntry::Append() {
  if (error_) std::rethrow_exception(error_);
  if (!pending_) return;
  const WhileWriting no_interrupt;
  pending_->Commit();
  pending_.reset();
}

}  // namespace hexcal
