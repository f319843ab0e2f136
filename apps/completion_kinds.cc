// SPDX-License-Identifier: BSD-3-Clause
#include "apps/completion_kinds.h"

#include "apps/flag_value.h"
#include "apps/flags.h"

namespace hexcal {
namespace {

using Sort = CompletionKind::Sort;

CompletionKind File(std::string_view extension) {
  return {Sort::kFile, {}, std::string(extension)};
}

// FILE.yaml is a file with that ending, FILE any.
CompletionKind KindOfValue(std::string_view value) {
  if (value == "DIR") return {Sort::kFolder};
  if (value == "PATH") return File("");
  if (value.substr(0, 4) != "FILE") return {};
  return File(value.size() > 5 && value[4] == '.' ? value.substr(5) : "");
}

bool Has(std::string_view text, std::string_view part) {
  return text.find(part) != std::string_view::npos;
}

}  // namespace

CompletionKind KindOfFlag(const CommandFlag& flag) {
  const FlagSpec& spec = *FindFlag(flag.name);
  if (IsSwitch(spec)) return {};
  if (!spec.choices.empty()) return {Sort::kWords, spec.choices};
  if (flag.name == "model" || flag.name == "dataset") return File("yaml");
  return KindOfValue(flag.value.empty() ? spec.value : flag.value);
}

CompletionKind KindOfFiles(const Command& command) {
  if (command.name == "schema") {
    CompletionKind commands = {Sort::kWords};
    for (const Command& each : Commands()) commands.words.push_back(each.name);
    return commands;
  }
  const std::string_view arguments = command.arguments;
  if (Has(arguments, "DATASET") || Has(arguments, "MANIFEST")) return File("yaml");
  if (Has(arguments, ".json")) return File("json");
  return Has(arguments, "FILE") ? File("") : CompletionKind();
}

std::string JoinWords(const std::vector<std::string_view>& words) {
  std::string text;
  for (const std::string_view word : words) text += (text.empty() ? "" : " ") + std::string(word);
  return text;
}

}  // namespace hexcal
