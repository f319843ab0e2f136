// SPDX-License-Identifier: BSD-3-Clause
#include "apps/record_of.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <gflags/gflags.h>

#include <ctime>

#include "apps/command.h"
#include "apps/dataset_files.h"
#include "apps/version.h"

namespace hexcal {

RunRecord RecordOf(std::string_view command, const Dataset& dataset, double seconds, int threads) {
  return RecordOf(command, InputFiles(dataset, ""), seconds, threads);
}

RunRecord RecordOf(std::string_view command,
                   const std::vector<std::string>& inputs,
                   double seconds,
                   int threads) {
  RunRecord record;
  record.version = VersionText();
  for (const CommandFlag& flag : FindCommand(command)->flags) {
    std::string value;
    gflags::GetCommandLineOption(std::string(flag.name).c_str(), &value);
    record.settings.emplace_back(flag.name, value);
  }
  record.inputs = inputs;
  record.started_utc = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
  record.seconds = seconds;
  record.threads = threads;
  return record;
}

}  // namespace hexcal
