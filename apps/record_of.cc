// SPDX-License-Identifier: BSD-3-Clause
#include "apps/record_of.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <ctime>

#include "apps/command.h"
#include "apps/dataset_files.h"
#include "apps/flag_value.h"
#include "apps/flags.h"
#include "apps/host.h"
#include "apps/version.h"

namespace hexcal {
namespace {

// As a shell reads it back.
std::string Quoted(const std::string& text) {
  const auto is_plain = [](unsigned char c) {
    return std::isalnum(c) || c > 127 ||
           std::string_view("_-./=:,+@%").find(c) != std::string::npos;
  };
  if (!text.empty() && std::all_of(text.begin(), text.end(), is_plain)) return text;
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? "'\\''" : std::string(1, c);
  return quoted + "'";
}

}  // namespace

RunRecord RecordOf(std::string_view command, const Dataset& dataset, double seconds, int threads) {
  return RecordOf(command, InputFiles(dataset, ""), seconds, threads);
}

RunRecord RecordOf(std::string_view command,
                   const std::vector<std::string>& inputs,
                   double seconds,
                   int threads) {
  RunRecord record;
  record.version = VersionText();
  record.revision = RevisionText();
  record.operator_name = FLAGS_operator;
  record.call = fmt::format("hexcal {}", command);
  if (!inputs.empty()) record.call += " " + Quoted(inputs.front());
  for (const CommandFlag& flag : FindCommand(command)->flags) {
    const FlagSpec& spec = *FindFlag(flag.name);
    const std::string value = CurrentText(spec);
    record.settings.emplace_back(flag.name, value);
    if (!WasGiven(spec) && !spec.default_text.empty())
      record.not_set.emplace_back(flag.name, spec.default_text);
    if (flag.name != "config" && WasGiven(spec))
      record.call += fmt::format(" --{}={}", flag.name, Quoted(value));
  }
  record.inputs = inputs;
  record.started_utc = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
  record.seconds = seconds;
  record.threads = threads;
  record.host = ThisHost();
  return record;
}

}  // namespace hexcal
