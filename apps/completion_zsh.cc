// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "apps/completion.h"
#include "apps/completion_kinds.h"
#include "apps/flag_value.h"
#include "apps/flags.h"
#include "apps/help.h"

namespace hexcal {
namespace {

using Sort = CompletionKind::Sort;

constexpr std::string_view kBegin = R"(#compdef hexcal
# Completion of hexcal in zsh: source <(hexcal completion zsh), or as _hexcal in a folder of fpath
_hexcal() {
  local -a commands
  commands=(
)";

constexpr std::string_view kMiddle = R"(  )
  if ((CURRENT == 2)); then
    _describe command commands
    return
  fi
  local command=$words[2]
  shift words
  ((CURRENT--))
  case $command in
    help) _describe command commands ;;
)";

constexpr std::string_view kEnd = R"(  esac
}

if [[ $zsh_eval_context[-1] == loadautofunc ]]; then
  _hexcal "$@"
else
  compdef _hexcal hexcal
fi
)";

// For a word between single quotes in which ':', '[' and ']' mean something.
std::string Escape(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '\'') {
      escaped += "'\\''";
      continue;
    }
    if (c == ':' || c == '[' || c == ']' || c == '\\') escaped += '\\';
    escaped += c;
  }
  return escaped;
}

// The first sentence.
std::string_view Short(std::string_view text) { return text.substr(0, text.find(". ")); }

std::string Action(const CompletionKind& kind) {
  switch (kind.sort) {
    case Sort::kNothing:
      return " ";
    case Sort::kWords:
      return fmt::format("({})", JoinWords(kind.words));
    case Sort::kFolder:
      return "_files -/";
    case Sort::kFile:
      break;
  }
  return kind.extension.empty() ? "_files" : fmt::format("_files -g \"*.{}\"", kind.extension);
}

std::string Spec(const CommandFlag& flag) {
  const bool is_switch = IsSwitch(*FindFlag(flag.name));
  std::string spec =
      fmt::format("--{}{}[{}]", flag.name, is_switch ? "" : "=", Escape(Short(FlagText(flag))));
  if (!is_switch) spec += fmt::format(":{}:{}", flag.name, Action(KindOfFlag(flag)));
  return fmt::format(" \\\n        '{}'", spec);
}

std::string CaseOf(const Command& command) {
  std::string text =
      fmt::format("    {})\n      _arguments -S '--help[explains the command]'", command.name);
  for (const CommandFlag& flag : command.flags) text += Spec(flag);
  if (!command.first_words.empty())
    text += fmt::format(" \\\n        '1:first:({})'", JoinWords(command.first_words));
  const CompletionKind rest = KindOfFiles(command);
  if (rest.sort != Sort::kNothing) text += fmt::format(" \\\n        '*:file:{}'", Action(rest));
  return text + "\n      ;;\n";
}

}  // namespace

std::string ZshCompletion() {
  std::string text(kBegin);
  for (const Command& command : Commands())
    text += fmt::format("    '{}:{}'\n", command.name, Escape(command.summary));
  text += "    'help:explains a command'\n";
  text += kMiddle;
  for (const Command& command : Commands()) text += CaseOf(command);
  return text + std::string(kEnd);
}

}  // namespace hexcal
