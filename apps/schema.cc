// SPDX-License-Identifier: BSD-3-Clause
#include "apps/schema.h"

#include <fmt/format.h>

#include "apps/exit_status.h"
#include "apps/schemas.h"
#include "apps/usage_error.h"
#include "config/nearest_word.h"

namespace hexcal {
namespace {

const SchemaInfo& RequireSchema(const std::string& name) {
  if (const SchemaInfo* info = FindSchema(name)) return *info;
  std::string names;
  std::vector<std::string_view> known;
  for (const SchemaInfo& info : Schemas()) {
    names += fmt::format("{}{}", names.empty() ? "" : ", ", info.name);
    known.push_back(info.name);
  }
  throw UsageError(
      fmt::format("schema: NAME: found '{}', expected one of {}{}\nTry 'hexcal help schema'.",
                  name,
                  names,
                  DidYouMean(name, known)));
}

const Command& CommandOf(const std::string& schema, const std::string& name) {
  if (schema != "settings")
    throw UsageError(fmt::format(
        "schema: found the command '{}', expected none: only settings differ by command", name));
  if (const Command* command = FindCommand(name)) return *command;
  std::vector<std::string_view> known;
  for (const Command& command : Commands()) known.push_back(command.name);
  throw UsageError(fmt::format(
      "schema: unknown command '{}'{}\nTry 'hexcal help'.", name, DidYouMean(name, known)));
}

int RunSchema(const std::vector<std::string>& words) {
  if (words.empty()) {
    for (const SchemaInfo& info : Schemas()) fmt::print("{:<14} {}\n", info.name, info.summary);
    return kDone;
  }
  const SchemaInfo& info = RequireSchema(words[0]);
  const Command* command = words.size() > 1 ? &CommandOf(words[0], words[1]) : nullptr;
  fmt::print("{}\n", WholeSchema(info, command).dump(2));
  return kDone;
}

std::string_view SchemaDescription() {
  static const std::string text = [] {
    std::string all =
        "Prints the JSON Schema (draft 2020-12) of a kind of file that hexcal reads or writes, for "
        "editors that complete and check YAML while it is written, and for programs that read "
        "results. COMMAND: whose settings. Without NAME it lists the kinds:";
    for (const SchemaInfo& info : Schemas())
      all += fmt::format("\n  {}: {}", info.name, info.summary);
    return all;
  }();
  return text;
}

std::vector<std::string_view> SchemaNames() {
  std::vector<std::string_view> names;
  for (const SchemaInfo& info : Schemas()) names.push_back(info.name);
  return names;
}

}  // namespace

Command SchemaCommand() {
  return {"schema",
          "JSON Schemas of the files that hexcal reads and writes",
          "[NAME [COMMAND]]",
          0,
          2,
          SchemaDescription(),
          {},
          &RunSchema,
          {{"hexcal schema dataset > dataset.schema.json",
            "For an editor that checks YAML while it is written."}},
          SchemaNames()};
}

}  // namespace hexcal
